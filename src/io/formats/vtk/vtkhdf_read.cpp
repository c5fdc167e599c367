// Reads VTKHDF, VTK's format for unstructured grids in HDF5: versions 1 and 2, of one time step.
//
//   /VTKHDF                      attributes Version and Type
//     NumberOfPoints NumberOfCells NumberOfConnectivityIds    one number per piece
//     Points Connectivity Offsets Types                       of all pieces, one after the other
//     PointData CellData FieldData                            groups of arrays, a row for each point, cell, tuple
//
// Each piece numbers its points from 0, and has one more offsets than cells, from 0. If pieces meet in a point, each
// has it, and the copies become one. Cells that a piece has from its neighbor (ghosts) are left out.
#include <algorithm>
#include <limits>
#include <numeric>
#include <span>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "io/containers/hdf5_file.hpp"
#include "io/containers/hdf5_magic.hpp"
#include "io/conversion/globe.hpp"
#include "io/formats/cells.hpp"
#include "io/formats/format.hpp"
#include "io/formats/vtk/vtk_arrays.hpp"
#include "io/formats/vtk/vtkhdf.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_vtkhdf(std::string_view head) { return is_hdf5(head); }

namespace {

constexpr std::string_view kGhosts = "vtkGhostType";  // of cells: bits
constexpr int kDuplicateCell = 1;
constexpr std::int64_t kMostOfPiece = std::numeric_limits<std::int32_t>::max();

class VtkhdfReader {
 public:
  VtkhdfReader(const Hdf5Reader& in, Hdf5Id&& group, Source& source)
      : in_(in), group_(std::move(group)), source_(source), document_(new_document(source.path)) {}

  Document read() {
    check_header();
    document_.file.field_data = arrays("FieldData", std::nullopt, "field data");
    read_points();
    read_cells();
    read_point_data();
    take_physical_names(document_);
    take_period(document_);
    return std::move(document_);
  }

 private:
  /// The start of a piece in the arrays of the file.
  struct Start {
    std::size_t piece = 0, points = 0, cells = 0, ids = 0;
  };

  void check_header() const {
    const std::vector<std::int64_t> version = in_.integer_attribute(group_, "Version");
    if (version.size() != 2)
      fail(ErrorCode::syntax, path_, "has no attribute Version of two integers in the group VTKHDF");
    if (version[0] != 1 && version[0] != 2) {
      fail(ErrorCode::unsupported, path_, "is VTKHDF of version ", version[0], ".", version[1],
           "; temper reads versions 1 and 2");
    }
    const auto type = in_.text_attribute(group_, "Type");
    if (!type) fail(ErrorCode::syntax, path_, "has no attribute Type of text in the group VTKHDF");
    if (*type != kVtkhdfType) {
      fail(ErrorCode::unsupported, path_, "is a VTKHDF file of type ", in_quotes(*type), "; temper reads ",
           kVtkhdfType);
    }
    const auto steps = in_.group(group_, "Steps");
    const auto n = steps ? in_.integer_attribute(*steps, "NSteps") : std::vector<std::int64_t>{1};
    if (n.size() != 1 || n[0] != 1) {
      fail(ErrorCode::unsupported, path_, "has ", n.size() == 1 ? to_text(n[0]) : "an unknown number of",
           " time steps; temper reads files of one: write one alone");
    }
  }
  [[nodiscard]] std::vector<std::size_t> counts(const char* name, std::int64_t most) const {
    std::vector<std::size_t> result;
    for (const std::int64_t n : in_.long_integers(in_.dataset(group_, name))) {
      if (n < 0 || n > most)
        fail(ErrorCode::syntax, path_, name, " of piece ", result.size(), " is ", n, "; expected a number");
      result.push_back(static_cast<std::size_t>(n));
    }
    const std::size_t pieces = piece_points_.empty() ? result.size() : piece_points_.size();
    if (result.empty() || result.size() != pieces) {
      fail(ErrorCode::size_mismatch, path_, name, " has ", result.size(), " numbers, expected one per piece",
           pieces > 0 ? text(", of which NumberOfPoints has ", pieces) : "");
    }
    return result;
  }
  [[nodiscard]] std::size_t total(const std::vector<std::size_t>& counts, std::string_view what) const {
    const std::size_t n = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
    if (!std::in_range<std::int32_t>(n))
      fail(ErrorCode::syntax, path_, "has ", n, " ", what, ", more than 32 bits count");
    return n;
  }
  [[nodiscard]] Hdf5Dataset dataset(const char* name, std::size_t rows, std::size_t columns) const {
    Hdf5Dataset found = in_.dataset(group_, name);
    const auto& sizes = found.sizes;
    const bool good = columns == 1 ? sizes == std::vector<std::size_t>{rows} : sizes == std::vector{rows, columns};
    if (good) return found;
    std::string have;
    for (const std::size_t size : sizes) have += text(have.empty() ? "" : " times ", size);
    fail(ErrorCode::size_mismatch, path_, "the dataset ", in_quotes(name), " has ", have, " values, expected ", rows,
         columns == 1 ? "" : text(" times ", columns));
  }
  void read_points() {
    piece_points_ = counts("NumberOfPoints", kMostOfPiece);
    const std::size_t n = total(piece_points_, "points");
    const std::vector<double> all = in_.reals(dataset("Points", n, 3));
    const auto place = [&all](std::size_t i) { return Vec3{all[3 * i], all[3 * i + 1], all[3 * i + 2]}; };
    MeshFile& f = document_.file;
    RunLength& kept = document_.names->points;
    if (several()) {
      joined_ = join_points(piece_points_, place);
      kept = joined_.kept;
    } else {
      kept = RunLength(0, n);
    }
    if (kept.size() < n) {
      f.warnings.push_back(text(path_, ": ", n - kept.size(),
                                " points are where points of other pieces are; each is one "
                                "with the first there, whose data it has"));
    }
    f.points.reserve(kept.size());
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Vec3 p = place(static_cast<std::size_t>(kept[static_cast<std::int64_t>(i)]));
      f.points.push_back({p.x, p.y});
      plane.add(i, p.z);
    }
  }
  void read_cells() {
    piece_cells_ = counts("NumberOfCells", kMostOfPiece);
    piece_ids_ = counts("NumberOfConnectivityIds", 3 * kMostOfPiece);
    const std::size_t n = total(piece_cells_, "cells"), pieces = piece_points_.size();
    const std::size_t n_ids = std::accumulate(piece_ids_.begin(), piece_ids_.end(), std::size_t{0});
    connectivity_ = in_.integers(dataset("Connectivity", n_ids, 1));
    offsets_ = in_.long_integers(dataset("Offsets", n + pieces, 1));
    types_ = in_.integers(dataset("Types", n, 1));
    std::vector<DataArray> data = arrays("CellData", n, "cell data");
    if (several()) {
      if (const auto ghosts = take(data, kGhosts)) find_duplicates(*ghosts, n);
    }
    CellSorter sorter(document_, source_.allocation);
    sorter.reserve(n);
    Start start;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      start.piece = piece;
      sort_piece(sorter, start);
      start.points += piece_points_[piece];
      start.cells += piece_cells_[piece];
      start.ids += piece_ids_[piece];
    }
    const auto release = [](auto& numbers) { std::remove_reference_t<decltype(numbers)>().swap(numbers); };
    release(connectivity_), release(types_), release(offsets_);
    sorter.distribute(std::move(data));
  }
  /// Bits mark ghost cells, in integers of any type.
  void find_duplicates(const DataArray& ghosts, std::size_t n) {
    const bool known = std::visit(
        [&](const auto& bits) {
          using Bits = typename std::decay_t<decltype(bits)>::value_type;
          if constexpr (std::is_integral_v<Bits>) {
            if (bits.size() != n) return false;
            is_duplicate_.resize(n);
            for (std::size_t i = 0; i < n; ++i) is_duplicate_[i] = (bits[i] & kDuplicateCell) != 0;
            return true;
          } else {
            return false;
          }
        },
        ghosts.values);
    if (known) return;
    document_.file.warnings.push_back(
        text(path_, ": cell data ", kGhosts, " is no integer for each cell: all cells are taken"));
  }
  void sort_piece(CellSorter& sorter, const Start& start) {
    const std::size_t n_ids = piece_ids_[start.piece];
    const std::int64_t* offsets = offsets_.data() + start.cells + start.piece;
    for (std::size_t i = 0; i < piece_cells_[start.piece]; ++i) {
      const std::size_t cell = start.cells + i;
      const std::int64_t first = offsets[i], end = offsets[i + 1];
      if (first < 0 || end < first || static_cast<std::uint64_t>(end) > n_ids) {
        fail(ErrorCode::index_out_of_range, path_, "element ", cell, " ends at ", end, " of ", n_ids,
             " connectivity values, and starts at ", first);
      }
      std::int32_t* ids = connectivity_.data() + start.ids + first;
      const auto n = static_cast<std::size_t>(end - first);
      if (!is_duplicate_.empty() && is_duplicate_[cell]) {
        sorter.add(kVtkEmptyCell, ids, 0, path_);
        continue;
      }
      if (several()) number_in_mesh(ids, n, cell, start);
      sorter.add(types_[cell], ids, n, path_);
    }
  }
  void number_in_mesh(std::int32_t* ids, std::size_t n, std::size_t cell, const Start& start) const {
    for (std::int32_t& id : std::span(ids, n)) {
      if (id < 0 || static_cast<std::size_t>(id) >= piece_points_[start.piece]) {
        fail(ErrorCode::index_out_of_range, path_, "element ", cell, " uses vertex ", id, ", but its piece has ",
             piece_points_[start.piece], " vertices, numbered from 0");
      }
      id = joined_.number[start.points + static_cast<std::size_t>(id)];
    }
  }
  void read_point_data() {
    const std::size_t n = std::accumulate(piece_points_.begin(), piece_points_.end(), std::size_t{0});
    std::vector<DataArray> data = arrays("PointData", n, "point data");
    if (several()) {
      static_cast<void>(take(data, kGhosts));
      for (DataArray& a : data) a.values = gather(a.values, a.components, joined_.kept);
    }
    take_point_data(document_, std::move(data));
  }
  [[nodiscard]] std::vector<DataArray> arrays(const char* name, std::optional<std::size_t> rows,
                                              std::string_view kind) {
    const auto group = in_.group(group_, name);
    if (!group) return {};
    std::vector<Hdf5Dataset> datasets;
    for (const std::string& each : in_.names(*group)) {
      auto found = in_.find(*group, each);
      if (found && found->scalar) {
        datasets.push_back(std::move(*found));
      } else {
        document_.file.warnings.push_back(
            text(path_, ": ", kind, " ", in_quotes(each), " holds no numbers and is dropped"));
      }
    }
    const auto type_of = [&](std::string_view wanted) -> std::optional<TypeOfArray> {
      const auto it =
          std::find_if(datasets.begin(), datasets.end(), [&](const Hdf5Dataset& d) { return d.name == wanted; });
      if (it == datasets.end()) return std::nullopt;
      return TypeOfArray{*it->scalar, it->sizes.size() == 1 ? 1 : 2};
    };
    if (kind == "cell data")
      std::erase_if(datasets, [rows = quality_among(type_of)](const Hdf5Dataset& d) {
        return std::ranges::find(rows, d.name, &QualityArray::name) != rows.end();
      });
    std::vector<DataArray> result;
    result.reserve(datasets.size());
    for (const Hdf5Dataset& d : datasets) result.push_back(array(d, rows, kind));
    return result;
  }
  [[nodiscard]] DataArray array(const Hdf5Dataset& d, std::optional<std::size_t> rows, std::string_view kind) const {
    constexpr std::size_t kMostComponents = 4096;
    const std::size_t have = d.sizes.empty() ? 1 : d.sizes[0], components = d.sizes.size() < 2 ? 1 : d.sizes[1];
    if (d.sizes.size() > 2 || components < 1 || components > kMostComponents) {
      fail(ErrorCode::unsupported, path_, kind, " ", in_quotes(d.name), " has ", d.sizes.size(), " dimensions and ",
           components, " columns; expected rows and columns");
    }
    if (rows && have != *rows) {
      fail(ErrorCode::size_mismatch, path_, kind, " ", in_quotes(d.name), " has ", have, " rows, expected ", *rows);
    }
    return {in_.text_attribute(d.id, kVtkhdfName).value_or(d.name), static_cast<int>(components), in_.values(d)};
  }
  [[nodiscard]] bool several() const { return piece_points_.size() > 1; }

  const Hdf5Reader& in_;
  Hdf5Id group_;
  Source& source_;
  const std::string& path_ = source_.path;
  Document document_;
  std::vector<std::size_t> piece_points_, piece_cells_, piece_ids_;
  JoinedPoints joined_;  // of several pieces
  std::vector<std::int32_t> connectivity_, types_;
  std::vector<std::int64_t> offsets_;
  std::vector<bool> is_duplicate_;  // by cell; empty: none is
};

}  // namespace

// All other HDF5 files go to the reader of NetCDF. The name of a group is in plain bytes of its file, so that files
// without it need no libhdf5.
Document read_vtkhdf(Source& source) {
  if (source.bytes.find(kVtkhdfGroup) != std::string::npos) {
    const Hdf5Reader in(source);
    if (auto group = in.group(in.root(), std::string(kVtkhdfGroup)))
      return VtkhdfReader(in, std::move(*group), source).read();
  }
  return read_ugrid(source);
}

JoinedPoints join_points(const std::vector<std::size_t>& sizes, const std::function<Vec3(std::size_t)>& place) {
  JoinedPoints result;
  std::unordered_map<Vec3, std::int32_t, PlaceHash> former;  // of the pieces before this one
  std::size_t start = 0;
  for (const std::size_t size : sizes) {
    const std::size_t end = start + size;
    for (std::size_t i = start; i < end; ++i) {
      const auto there = former.find(place(i));
      result.number.push_back(there != former.end() ? there->second : static_cast<std::int32_t>(result.kept.size()));
      if (there == former.end()) result.kept.push_back(static_cast<std::int64_t>(i));
    }
    for (std::size_t i = start; i < end; ++i) former.emplace(place(i), result.number[i]);
    start = end;
  }
  return result;
}

}  // namespace temper::io
