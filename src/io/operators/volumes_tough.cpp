// MESH of TOUGH2, TOUGH3 and iTOUGH2. It has the blocks ELEME and CONNE in fixed columns, each ended by an empty line.
// (Pruess, Oldenburg, Moridis: TOUGH2 user's guide, LBNL-43134, chapter 8.)
//
//   ELEME   name(5) NSEQ(5) NADD(5) rock(5) VOLX AHTX PMX X Y Z            ten columns each number
//   CONNE   name(5) name(5) NSEQ NAD1 NAD2 ISOT(5 each) D1 D2 AREAX BETAX
#include <array>
#include <cmath>

#include "io/operators/volumes.hpp"
#include "temper/detail/read_number.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
constexpr std::size_t kLetters = 26, kNumbers = 90;  // 10 … 99: two digits for programs that read them as a number
constexpr std::size_t kMostNames = kLetters * kDigits.size() * kDigits.size() * kNumbers;
constexpr std::size_t kMostRocks = 99;

std::string right_aligned(const std::string& value, std::size_t columns) {
  return value.size() < columns ? std::string(columns - value.size(), ' ') + value : value;
}

/// The value with as many digits as there is room for, as Fortran reads it. It needs a point: E10.4 inserts one four
/// digits before the end of a 12.
std::string in_ten_columns(double value) {
  constexpr std::size_t kColumns = 10;
  constexpr int kMostDigits = 9;
  constexpr double kAsGoodAsAny = 1e-7;  // relative: with an exponent there are seven digits or less
  std::string best;
  double least = HUGE_VAL;
  for (const std::chars_format form : {std::chars_format::fixed, std::chars_format::scientific}) {
    if (least <= kAsGoodAsAny * std::abs(value)) break;
    for (int digits = kMostDigits; digits >= 0; --digits) {
      std::array<char, 400> buffer;
      const auto [end, failed] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, form, digits);
      std::string number(buffer.data(), end);
      std::string exponent;
      if (const std::size_t e = number.find('e'); e != std::string::npos) {
        const std::size_t first = number.find_first_not_of('0', e + 2);
        exponent = "E" + std::string(number[e + 1] == '-' ? "-" : "") +
                   (first == std::string::npos ? "0" : number.substr(first));
        number.resize(e);
      }
      if (number.find('.') == std::string::npos) number += '.';
      number += exponent;
      if (number.size() > kColumns) continue;
      double read = 0;
      read_number(number.data(), number.data() + number.size(), read);
      if (std::abs(read - value) < least) least = std::abs(read - value), best = number;
      break;
    }
  }
  return right_aligned(best, kColumns);
}

/// The rock by its number, as the n-th of ROCKS. None beyond two digits: then TOUGH takes the first.
std::string rock(std::size_t material) {
  return right_aligned(material > 0 && material <= kMostRocks ? to_text(material) : "", 5);
}

/// The cosine of the angle between the connection, from its first element to the second, and gravity. For neighbors at
/// different heights it is the drop over the distance: water at rest then stays at rest.
double downward(const FiniteVolumes& volumes, const FiniteVolumes::Connection& c) {
  if (c.is_vertical) return 1;
  return (volumes.cells[c.first].center.z - volumes.cells[c.second].center.z) / (c.first_distance + c.second_distance);
}

}  // namespace

// "AAA10", "AAA11", …: three letters or digits, the first one a letter, and a number of two digits.
std::string tough_name(std::size_t cell) {
  const std::size_t word = cell / kNumbers, n = kDigits.size();
  std::string name = {kDigits[word / (n * n)], kDigits[word / n % n], kDigits[word % n]};
  return name + to_text(10 + cell % kNumbers);
}

void write_volumes_tough(const DecFolder& folder, const FiniteVolumes& volumes) {
  if (volumes.n_numbers > kMostNames)
    fail(ErrorCode::unsupported, "", volumes.n_numbers, " cells are more than TOUGH's ", kMostNames, " names");
  const std::string none5(5, ' '), none10(10, ' ');
  Output& out = folder.open("MESH");
  out.put("ELEME\n");
  for (const auto& [number, at, volume, material] : volumes.cells) {
    out.put(tough_name(number), none5, none5, rock(material), in_ten_columns(volume), none10, none10,
            in_ten_columns(at.x), in_ten_columns(at.y), in_ten_columns(at.z), '\n');
  }
  out.put("\nCONNE\n");
  for (const FiniteVolumes::Connection& c : volumes.connections) {
    out.put(tough_name(volumes.cells[c.first].number), tough_name(volumes.cells[c.second].number), none5, none5, none5,
            right_aligned(c.is_vertical ? "3" : "1", 5), in_ten_columns(c.first_distance),
            in_ten_columns(c.second_distance), in_ten_columns(c.area), in_ten_columns(downward(volumes, c)), '\n');
  }
  out.put('\n');
}

}  // namespace temper::io
