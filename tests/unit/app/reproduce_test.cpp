// temper paper reproduce, with figures that take a moment.
#include <signal.h>

#include <chrono>
#include <thread>

#include "workshop.hpp"

namespace temper::test {
namespace {

using namespace std::chrono_literals;
using Names = std::vector<std::string>;

class Reproduce : public Workshop {};

/// The files in the folder that are no pictures.
Names without_pictures(Names names) {
  std::erase_if(names, [](const std::string& name) { return name.ends_with(".svg"); });
  return names;
}

TEST_F(Reproduce, WritesPicturesAPageAndClaims) {
  const Outcome outcome = temper_ok({"paper", "reproduce", "6", "-o", "new/folder", "--reduced"});
  EXPECT_EQ(outcome.err, "");  // no progress in a pipe
  EXPECT_TRUE(contains(outcome.out, "Hard barrier energy of one edge"));
  const std::string page = read("new/folder/index.html");
  const nlohmann::json json = read_json("new/folder/gallery.json");
  EXPECT_EQ(json["version"], TEMPER_VERSION);
  ASSERT_EQ(json["figures"].size(), 1u);
  ASSERT_FALSE(json["figures"][0]["pictures"].empty());
  for (const std::string name : json["figures"][0]["pictures"]) {
    EXPECT_TRUE(contains(read("new/folder/" + name), "</svg>"));
    EXPECT_TRUE(contains(page, "src=\"" + name + "\""));
  }
  ASSERT_FALSE(json["claims"].empty());
  for (const nlohmann::json& claim : json["claims"]) {
    for (const char* key : {"figure", "claim", "paper", "temper", "why"}) EXPECT_TRUE(claim[key].is_string()) << key;
    EXPECT_TRUE(claim["holds"].is_boolean());
    EXPECT_TRUE(claim["author"] == "paper" || claim["author"] == "temper");
  }
  EXPECT_EQ(without_pictures(names()),
            (Names{"claims.md", "folder", "gallery.json", "index.html", "new", "settings.md"}));
}

TEST_F(Reproduce, OneReadingIsInThePlaceOfTheFiguresOwn) {
  temper_ok({"paper", "reproduce", "13", "-o", "own", "--reduced"});
  temper_ok(
      {"paper", "reproduce", "13", "-o", "read", "--reduced", "--set", "order=reverse", "--set", "gamma=0.5:absolute"});
  EXPECT_TRUE(contains(read("own/settings.md"), " | input | rms | 1 | refuse | 1:absolute |"));
  EXPECT_TRUE(contains(read("read/settings.md"), " | reverse | rms | 1 | refuse | 0.5:absolute |"));
  const Outcome outcome = temper({"paper", "reproduce", "20", "-o", "none", "--reduced", "--set", "inversion=allow"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "figure 20 cannot be made under this reading: "));
}

TEST_F(Reproduce, WritesTheSameBytesTwice) {
  temper_ok({"paper", "reproduce", "6,7", "-o", "a", "--reduced"});
  temper_ok({"paper", "reproduce", "7", "6", "-o", "b", "--reduced"});
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator("a")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(read("a/" + name), read("b/" + name)) << name;
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST_F(Reproduce, ListNamesEveryFigureAndWritesNothing) {
  const Outcome outcome = temper_ok({"paper", "reproduce", "--list"});
  EXPECT_TRUE(contains(outcome.out, " 6  Hard barrier energy of one edge\n"));
  EXPECT_EQ(temper_ok({"paper", "reproduce", "6", "--list"}).out, " 6  Hard barrier energy of one edge\n");
  EXPECT_TRUE(names().empty());
}

TEST_F(Reproduce, BadUsageTouchesNothing) {
  for (const char* figure : {"0", "33", "six", "6,", "7-6"}) {
    EXPECT_EQ(temper({"paper", "reproduce", figure, "-o", "out"}).exit, 2) << figure;
  }
  EXPECT_EQ(temper({"paper", "reproduce", "6"}).exit, 2);
  EXPECT_EQ(temper({"paper", "reproduce", "6", "-o", "out", "--reducd"}).exit, 2);
  EXPECT_TRUE(names().empty());
}

TEST_F(Reproduce, AFolderThatCannotBeIsNamedBeforeTheWork) {
  write("file", "mine");
  for (const char* folder : {"file", "file/below"}) {
    const Outcome outcome = temper({"paper", "reproduce", "6", "--reduced", "-o", folder});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_TRUE(contains(outcome.err, std::string(folder) + ": cannot be written: "));
  }
  EXPECT_EQ(read("file"), "mine");
  EXPECT_EQ(names(), Names{"file"});
}

TEST_F(Reproduce, ClaimsThatDoNotHoldAreAnErrorOnlyWhenAskedFor) {
  temper_ok({"paper", "reproduce", "6", "--reduced", "-o", "out"});
  std::size_t failing = 0;
  const nlohmann::json json = read_json("out/gallery.json");
  for (const nlohmann::json& claim : json["claims"]) failing += claim["holds"].get<bool>() ? 0 : 1;
  const Outcome outcome = temper({"paper", "reproduce", "6", "--reduced", "-o", "out", "--require-claims"});
  EXPECT_EQ(outcome.exit, failing > 0 ? 3 : 0);
  EXPECT_EQ(outcome.err.empty(), failing == 0) << outcome.err;
}

TEST_F(Reproduce, ASignalLeavesWholeFilesThatFitTogether) {
  int stopped = 0;
  for (const auto delay : {5ms, 20ms, 80ms}) {
    const pid_t process = start({"paper", "reproduce", "-o", "out", "--reduced"}, "out.txt", "err.txt");
    std::this_thread::sleep_for(delay);
    kill(process, SIGINT);
    stopped += wait_for(process) == -SIGINT;
    std::filesystem::create_directory("out");  // the signal may have come before it
    for (const auto& entry : std::filesystem::directory_iterator("out")) {
      const std::string name = entry.path().filename().string();
      if (name == "gallery.json") {
        const nlohmann::json json = read_json("out/gallery.json");
        for (const nlohmann::json& figure : json["figures"]) {
          for (const std::string picture : figure["pictures"]) EXPECT_TRUE(exists("out/" + picture)) << picture;
        }
      } else if (name == "claims.md" || name == "settings.md") {
        EXPECT_TRUE(read("out/" + name).ends_with("\n"));
      } else {
        EXPECT_TRUE(contains(read("out/" + name), name == "index.html" ? "</html>" : "</svg>")) << name;
      }
    }
    std::filesystem::remove_all("out");
  }
  EXPECT_GT(stopped, 0);
}

}  // namespace
}  // namespace temper::test
