// Inputs that cannot be used and outputs that cannot be written: exit code 1, a message, nothing left behind.
#include <sys/resource.h>
#include <unistd.h>

#include "support/sanitizers.hpp"
#include "workshop.hpp"

namespace temper::test {
namespace {

class BadInput : public Workshop {
 protected:
  /// Runs optimize on in.mesh with these bytes, which is refused there for that reason; nothing may appear beside it.
  static void expect_refused(const std::string& bytes, const std::string& where, const std::string& why) {
    write("in.mesh", bytes);
    const Outcome outcome = temper({"optimize", "in.mesh", "-o", "out.vtu", "--write", "report.json"});
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_EQ(names(), std::vector<std::string>{"in.mesh"});
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("temper: error: " + where + ": " + why, 0), 0u) << outcome.err;
  }
  /// A medit file of a unit square with a midpoint; one thing is wrong with it.
  static std::string square(const std::string& midpoint,
                            const std::string& triangles = "4\n1 2 5 0\n2 3 5 0\n3 4 5 0\n4 1 5 0\n") {
    return "MeshVersionFormatted 2\nDimension 2\nVertices\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + midpoint +
           " 0\nTriangles\n" + triangles + "End\n";
  }
};

TEST_F(BadInput, MissingFile) {
  const Outcome outcome = temper({"optimize", "none.vtu", "-o", "out.vtu"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "temper: error: none.vtu: "));
  EXPECT_TRUE(names().empty());
}

TEST_F(BadInput, NoPathOrNameOrdersTheTerminalAround) {
  const Outcome missing = temper({"check", "\x1b[2Jnone.vtu"});
  EXPECT_TRUE(contains(missing.err, "temper: error: \\x1b[2Jnone.vtu: ")) << missing.err;
  write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng \x1b[2Jsteel\nf 1 2 3\n");
  const Outcome fixed = temper({"optimize", "m.obj", "-o", "out.vtu", "--fix", "\x1b[2J"});
  EXPECT_TRUE(contains(fixed.err, "there are: \\x1b[2Jsteel")) << fixed.err;
  for (const std::string& text : {missing.err, missing.out, fixed.err, fixed.out})
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
}

TEST_F(BadInput, DirectoryAsInput) {
  std::filesystem::create_directory("folder");
  const Outcome outcome = temper({"check", "folder"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_EQ(outcome.err, "temper: error: folder: is a directory, not a mesh file\n");
}

TEST_F(BadInput, EmptyFile) { expect_refused("", "in.mesh", "the file is empty"); }

TEST_F(BadInput, Garbage) {
  for (const std::string& bytes : {std::string("this is no mesh\n"), std::string(4096, '\0'),
                                   std::string("\x7f"
                                               "ELF\2\1\1")}) {
    expect_refused(bytes, "in.mesh", "is none of the formats that temper reads: VTK XML unstructured grid, ");
  }
}

TEST_F(BadInput, TruncatedFile) {
  const std::string whole = square("0.5 0.5");
  expect_refused(whole.substr(0, whole.find("Triangles") + 14), "in.mesh:11",
                 "announces 4 triangles, but only 3 bytes follow");
}

TEST_F(BadInput, IndexOutOfRange) {
  expect_refused(square("0.5 0.5", "1\n1 2 9 0\n"), "in.mesh:12",
                 "triangle 1 uses vertex 9, but the file has 5 vertices, numbered from 1");
}

TEST_F(BadInput, NotFinite) {
  expect_refused(square("nan 0.5"), "in.mesh:9", "point 5 has coordinates (nan, 0.5), expected finite numbers");
}

TEST_F(BadInput, DuplicatePoint) {
  expect_refused(square("0 0"), "in.mesh:12",
                 "triangle 1 has zero area: its corners point 1, point 2 and point 5 are collinear");
  expect_refused(square("0 0", "2\n1 2 3 0\n5 3 4 0\n"), "in.mesh:9",
                 "point 1 and point 5 are both at (0, 0); expected distinct points");
}

TEST_F(BadInput, TrianglesThatOverlapOrTouch) {
  expect_refused(square("0.5 0.5", "2\n1 2 3 0\n1 2 5 0\n"), "in.mesh:13",
                 "triangle 1 and triangle 2 lie on the same side of the edge from point 1 to point 2");
  expect_refused(square("0.75 0.25", "2\n1 2 3 0\n3 4 5 0\n"), "in.mesh:7",
                 "the mesh touches itself at point 3: its triangles are not one fan around it");
}

TEST_F(BadInput, OptionsThatDoNotFitTheMeshAreBadUsage) {
  make_input();
  const Outcome tag = temper({"optimize", "in.vtu", "--fix", "nowhere", "-o", "out.vtu"});
  EXPECT_EQ(tag.exit, 2);
  EXPECT_TRUE(contains(tag.err, "nowhere"));
  const Outcome anchor = temper({"optimize", "in.vtu", "--set", "anchor=123456", "-o", "out.vtu"});
  EXPECT_EQ(anchor.exit, 2);
  EXPECT_TRUE(contains(anchor.err, "there is no vertex 123456"));
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

// Outputs are looked at before the input is read, let alone optimized: the input here does not even exist.
TEST_F(BadInput, OutputsAreTriedBeforeTheWork) {
  std::filesystem::create_directory("folder");
  std::filesystem::create_directory("folder.json");
  write("file", "");
  const std::vector<std::pair<std::vector<std::string>, const char*>> cases = {
      {{"optimize", "in.vtu", "-o", "nowhere/out.vtu"},
       "nowhere/out.vtu: cannot be written: there is no directory nowhere"},
      {{"optimize", "in.vtu", "-o", "file/out.vtu"}, "file is not a directory"},
      {{"optimize", "in.vtu", "-o", "folder"}, "folder: cannot be written: it is a directory"},
      {{"optimize", "in.vtu", "-o", "out.vtu", "--write", "nowhere/r.json"}, "there is no directory nowhere"},
      {{"optimize", "in.vtu", "-o", "out.vtu", "--write", "folder.json"}, "it is a directory"},
      {{"draw", "in.vtu", "-o", "nowhere/p.svg"}, "there is no directory nowhere"},
      {{"convert", "in.vtu", "-o", "nowhere/out.msh"}, "there is no directory nowhere"},
      {{"example", "triangle", "-o", "nowhere/out.msh"}, "there is no directory nowhere"},
  };
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 1);
    EXPECT_TRUE(contains(outcome.err, message));
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"file", "folder", "folder.json"}));
}

TEST_F(BadInput, FolderWithoutPermission) {
  namespace fs = std::filesystem;
  fs::create_directory("locked");
  fs::permissions("locked", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_exec);
  Outcome outcome;
  if (geteuid() != 0) {
    outcome = temper({"optimize", "in.vtu", "-o", "locked/out.vtu"});
  } else {  // root may write everywhere: be nobody, with a program that nobody can reach
    fs::permissions(".", fs::perms::others_read | fs::perms::others_exec, fs::perm_options::add);
    fs::copy_file(TEMPER_PROGRAM, "temper");
    outcome = shell("setpriv --reuid=65534 --regid=65534 --clear-groups ./temper optimize in.vtu -o locked/out.vtu");
  }
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "locked/out.vtu: cannot be written: directory locked: Permission denied"));
}

TEST_F(BadInput, FullDiskForAReportSaysWhatWasWritten) {
  if (!exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  make_input();
  std::filesystem::create_symlink("/dev/full", "full.json");
  const Outcome outcome = temper({"optimize", "in.vtu", "-o", "out.vtu", "--write", "full.json"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "full.json: "));
  EXPECT_TRUE(contains(outcome.err, "No space left on device"));
  EXPECT_TRUE(contains(outcome.err, "written before that: out.vtu"));
  EXPECT_TRUE(exists("out.vtu"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(BadInput, FullDiskForStandardOutput) {
  if (!exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  make_input();
  const Outcome outcome = shell("temper check in.vtu --json > /dev/full");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "standard output: No space left on device"));
}

/// A link of our own to standard output: the test must never do harm to /dev/stdout.
void link_to_standard_output(const std::string& name) { std::filesystem::create_symlink("/proc/self/fd/1", name); }

TEST_F(BadInput, ClosedStandardOutputIsRefusedAndItsLinkStays) {
  if (!exists("/proc/self/fd")) GTEST_SKIP() << "no /proc here";
  make_input();
  const std::vector<std::string> suffixes = {"vtu", "json", "html", "csv", "jsonl", "svg"};
  for (const std::string& suffix : suffixes) link_to_standard_output("out." + suffix);
  const auto before = names();
  for (const std::string& suffix : suffixes) {
    const std::string mesh = suffix == "vtu" ? "-o out.vtu" : "-o mesh.vtu --write out." + suffix;
    const Outcome outcome = shell("temper optimize in.vtu " + mesh + " >&-");
    EXPECT_EQ(outcome.exit, 1) << suffix;
    EXPECT_TRUE(contains(outcome.err, "out." + suffix + ": cannot be written: the stream is closed"));
    EXPECT_EQ(std::filesystem::read_symlink("out." + suffix), "/proc/self/fd/1");
  }
  EXPECT_EQ(names(), before);
}

TEST_F(BadInput, StandardOutputWithoutANameIsWrittenOnAndItsLinkStays) {
  if (!exists("/proc/self/fd")) GTEST_SKIP() << "no /proc here";
  make_input();
  temper_ok({"convert", "in.vtu", "-o", "expected.msh"});
  link_to_standard_output("out.msh");
  const Outcome outcome =
      shell("(exec 3<nameless; rm nameless; echo first; temper convert in.vtu -o out.msh; cat <&3 >&2) >nameless");
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_EQ(outcome.err, "first\n" + read("expected.msh"));
  EXPECT_EQ(std::filesystem::read_symlink("out.msh"), "/proc/self/fd/1");
  EXPECT_EQ(names(), (std::vector<std::string>{"expected.msh", "in.vtu", "out.msh"}));
}

TEST_F(BadInput, NoFileTakesThePlaceOfClosedStandardOutputAndGetsWhatIsPrinted) {
  make_input();
  const Outcome outcome = shell("temper optimize in.vtu -o out.vtu --write trace.jsonl >&-");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "standard output: it is closed"));
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
  EXPECT_EQ(shell("temper optimize in.vtu -o out.vtu --write trace.jsonl --quiet >&- 2>&- <&-").exit, 0);
  EXPECT_TRUE(read("trace.jsonl").starts_with("{"));
  temper_ok({"paper", "replay", "in.vtu", "trace.jsonl", "-o", "again.vtu"});
}

TEST_F(BadInput, ALinkToAFileOfAMissingFolderIsRefusedBeforeTheWork) {
  make_input();
  std::filesystem::create_symlink("nowhere/out.vtu", "out.vtu");
  const Outcome outcome = temper({"optimize", "in.vtu", "-o", "out.vtu"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "out.vtu: cannot be written: there is no directory nowhere"));
  EXPECT_TRUE(std::filesystem::is_symlink("out.vtu"));
}

TEST_F(BadInput, ADeviceWithoutAnEndIsRefusedByItsFirstBytes) {
  if (!exists("/dev/zero")) GTEST_SKIP() << "no /dev/zero here";
  make_input();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"temper check /dev/zero", "/dev/zero: is none of the formats that temper reads"},
      {"temper check - < /dev/zero", "/dev/stdin: is none of the formats that temper reads"},
      {"temper mesh /dev/zero -o out.vtu --size 1", "/dev/zero: is no outline that temper reads"},
      {"temper optimize in.vtu -o out.vtu --options /dev/zero", "/dev/zero: is no text"},
      {"temper weights in.vtu -o out.vtu --constraints regular --edges /dev/zero", "/dev/zero: is no text"},
      {"temper paper replay in.vtu /dev/zero -o out.vtu", "/dev/zero: is no text"},
  };
  for (const auto& [command, message] : cases) {
    const Outcome outcome = shell("ulimit -t 20; " + command);
    EXPECT_EQ(outcome.exit, 1) << command;
    EXPECT_TRUE(contains(outcome.err, message));
  }
  EXPECT_EQ(names(), std::vector<std::string>{"in.vtu"});
}

TEST_F(BadInput, AFileLargerThanTheMemoryIsRefusedByItsFirstBytes) {
  write("sparse.msh", "");
  std::filesystem::resize_file("sparse.msh", std::uintmax_t{1} << 40);
  const Outcome outcome = temper({"check", "sparse.msh"});
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "sparse.msh: is none of the formats that temper reads"));
}

TEST_F(BadInput, AnEmptyNameIsMissing) {
  make_input();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"check", ""},
                                                {"check", "in.vtu", ""},
                                                {"optimize", "", "-o", "out.vtu"},
                                                {"convert", "", "-o", "out.vtu"},
                                                {"explain", ""},
                                                {"draw", "", "-o", "p.svg"}}) {
    const Outcome outcome = temper(words);
    EXPECT_EQ(outcome.exit, 2) << words[0];
    EXPECT_TRUE(contains(outcome.err, words[0] + ": IN is missing"));
  }
}

TEST_F(BadInput, MoreThreadsThanAFewTimesTheProcessorsAreRefused) {
  make_input();
  for (const std::string verb : {"check", "optimize", "convert"}) {
    std::vector<std::string> words = {verb, "in.vtu", "--threads", "20000"};
    if (verb != "check") words.insert(words.end(), {"-o", "out.vtu"});
    const Outcome outcome = temper(words);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, verb + ": --threads: 20000 is out of range, it must be <= "));
    EXPECT_TRUE(contains(outcome.err, "Next: leave it out"));
  }
  temper_ok({"check", "in.vtu", "--threads", "16"});
  EXPECT_FALSE(exists("out.vtu"));
}

#if !TEMPER_SANITIZED
TEST_F(BadInput, OutOfMemoryIsNoCrash) {
  const Outcome refused = shell("ulimit -v 300000; temper example random --vertices 50000000 -o out.vtu");
  EXPECT_EQ(refused.exit, 2);
  EXPECT_TRUE(contains(refused.err, "Next: at most "));
  EXPECT_TRUE(names().empty());
  // A file that fits, and a run that needs more: somewhere below the limit at which it ends well.
  temper_ok({"example", "sheared-grid", "--nx", "900", "--ny", "900", "-o", "in.vtu", "--encoding", "appended"});
  std::size_t out_of_memory = 0;
  bool done = false;
  for (int megabytes = 100; !done && megabytes < 400; megabytes += 5) {
    const Outcome outcome = shell("ulimit -v " + std::to_string(1024 * megabytes) +
                                  "; temper optimize in.vtu -o out.vtu --set max_sweeps=0 --threads 1");
    done = outcome.exit == 0 || outcome.exit == 4;
    if (done) break;
    EXPECT_TRUE(outcome.exit == 5 || outcome.exit == 1) << outcome.exit;
    out_of_memory += outcome.exit == 5 ? 1 : 0;
    EXPECT_TRUE(contains(outcome.err, outcome.exit == 5 ? "temper: error: out of memory" : "needs more memory"));
    EXPECT_EQ(names(), (std::vector<std::string>{"in.vtu"}));
  }
  EXPECT_TRUE(done);
  EXPECT_GT(out_of_memory, 0u);
}
#endif

TEST_F(BadInput, SpheresAreRefusedByWhatIsForThePlane) {
  temper_ok({"example", "icosahedral", "--level", "2", "-o", "globe.vtu"});
  struct Row {
    std::vector<std::string> arguments;
    const char* what;
  };
  for (const auto& [arguments, what] :
       std::vector<Row>{{{"check", "globe.vtu", "--write", "out.html"}, "--write out.html"},
                        {{"optimize", "globe.vtu", "-o", "out.vtu", "--write", "out.html"}, "--write out.html"}}) {
    const Outcome outcome = temper(arguments);
    EXPECT_EQ(outcome.exit, 1) << arguments[0];
    EXPECT_EQ(outcome.err, std::string("temper: error: globe.vtu: the mesh is on a sphere, but ") + what +
                               " needs a mesh of the plane. Next: --projection puts longitude and latitude on a map\n");
    EXPECT_EQ(names(), std::vector<std::string>{"globe.vtu"});
  }
}

// A limit on the size of files stands for a disk that fills up while the mesh is written.
TEST_F(BadInput, FullDiskForTheMeshKeepsTheOldOne) {
  make_input();
  write("out.vtu", "what was there before");
  const Outcome outcome = shell("trap '' XFSZ; ulimit -f 1; temper optimize in.vtu -o out.vtu --quiet");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_TRUE(contains(outcome.err, "out.vtu"));
  EXPECT_EQ(read("out.vtu"), "what was there before");
  EXPECT_EQ(names(), (std::vector<std::string>{"in.vtu", "out.vtu"}));
}

// Where libnetcdf is not found: whoever has no NetCDF files does not notice, and others are told before anything is
// done.
TEST_F(BadInput, WithoutLibnetcdfFilesOfNetcdfAreRefusedBeforeTheWork) {
  make_input();
  const std::string without = "TEMPER_NETCDF=/nowhere/libnetcdf.so temper ";
  EXPECT_EQ(shell(without + "check in.vtu").exit, 0);
  for (const char* command : {"optimize in.vtu -o out.mpas.nc", "convert in.vtu -o out.ugrid.nc"}) {
    const Outcome outcome = shell(without + command);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, ".nc: NetCDF files need libnetcdf 4.6.2 or later")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "/nowhere/libnetcdf.so")) << outcome.err;
  }
  write("in.nc", std::string("CDF\1\0\0\0\0", 8));
  EXPECT_TRUE(contains(shell(without + "check in.nc").err, "in.nc: NetCDF files need libnetcdf"));
  EXPECT_TRUE(contains(shell(without + "--version").out, "\n  NetCDF        not found"));
  EXPECT_EQ(names(), (std::vector<std::string>{"in.nc", "in.vtu"}));
}

TEST_F(BadInput, WithoutLibhdf5FilesOfVtkhdfAreRefusedBeforeTheWork) {
  make_input();
  const std::string without = "TEMPER_HDF5=/nowhere/libhdf5.so temper ";
  EXPECT_EQ(shell(without + "check in.vtu").exit, 0);
  for (const char* command : {"optimize in.vtu -o out.vtkhdf", "convert in.vtu -o out.hdf"}) {
    const Outcome outcome = shell(without + command);
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_TRUE(contains(outcome.err, ": VTKHDF files need libhdf5 1.10 or later")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "/nowhere/libhdf5.so")) << outcome.err;
  }
  write("in.hdf", "\x89HDF\r\n\x1a\nVTKHDF");
  EXPECT_TRUE(contains(shell(without + "check in.hdf").err, "in.hdf: VTKHDF files need libhdf5"));
  EXPECT_TRUE(contains(shell(without + "--version").out, "\n  HDF5          not found"));
  EXPECT_EQ(names(), (std::vector<std::string>{"in.hdf", "in.vtu"}));
}

TEST_F(BadInput, WithoutGdalTheProgramSaysSo) {
  const std::string without = "TEMPER_GDAL=/nowhere/libgdal.so temper ";
  EXPECT_TRUE(contains(shell(without + "--version").out, "\n  GDAL          not found"));
  write("in.shp", std::string("\0\0\x27\x0a", 4));
  EXPECT_TRUE(contains(shell(without + "mesh in.shp -o out.vtu --size 1").err, "need GDAL 3 or later"));
}

}  // namespace
}  // namespace temper::test
