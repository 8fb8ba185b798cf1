// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/output/detail/xml_text.hpp"
#include "hmps/output/file_replacement.hpp"
#include "hmps/output/position_field.hpp"
#include "hmps/output/pvd_text.hpp"
#include "hmps/output/vtk_field.hpp"

namespace hmps::inline HMPS_ABI {

/// Names of the values 0, 1, 2, ... of an integer field, such as organs. The file contains them as a list of words that
/// is named after the field, for example "organ names".
struct VtkNames {
  std::string field;               ///< the field whose values are named
  std::vector<std::string> names;  ///< the names of the values 0, 1, 2, ...
};

/// The contents of a VTU file besides positions and fields.
struct VtuSettings {
  double time = 0;  ///< s, as ParaView shows it
  /// Triangles between the points, such as those of a surface; without triangles, each point is a cell of its own.
  std::span<const std::array<Index, 3>> triangles = {};
  std::vector<VtkNames> names = {};
};

namespace detail {

/// The byte order of this machine, as VTK calls it.
inline constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// Words as VTK stores them: the numbers of their bytes, with a zero after each word. Readers expect UTF-8 here too.
[[nodiscard]] inline std::string vtk_words(const VtkNames& names) {
  std::string text = "<Array type=\"String\" Name=\"" + xml(names.field) + " names\" NumberOfTuples=\"" +
                     std::to_string(names.names.size()) + "\" format=\"ascii\">\n";
  for (const std::string& name : names.names) {
    for (const char c : xml_characters(name)) text += std::to_string(static_cast<unsigned char>(c)) + ' ';
    text += "0\n";
  }
  return text + "</Array>\n";
}

/// The arrays of a VTK file: their descriptions, and their bytes one after another.
struct VtkArrays {
  std::string head, data;
  void add(const VtkField& field) {
    head += "<DataArray type=\"" + field.type + "\" Name=\"" + xml(field.name) + "\" NumberOfComponents=\"" +
            std::to_string(field.components) + "\" format=\"appended\" offset=\"" + std::to_string(data.size()) +
            "\"/>\n";
    const std::uint64_t length = field.bytes.size();
    data.append(reinterpret_cast<const char*>(&length), sizeof(length));
    data += field.bytes;
  }
};

/// Adds the cells: the triangles, or one for each of `size` points.
inline void add_cells(VtkArrays& arrays, std::size_t size, std::span<const std::array<Index, 3>> triangles) {
  std::vector<std::int32_t> connectivity, offsets;
  const std::size_t count = triangles.empty() ? size : triangles.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (triangles.empty()) connectivity.push_back(static_cast<std::int32_t>(k));
    for (std::size_t c = 0; c < 3 && !triangles.empty(); ++c) {
      require(triangles[k][c] < size, "hmps: triangle ", k, " of a VTU file names point ", triangles[k][c],
              " but there are only ", size, "; give the points that the triangles belong to");
      connectivity.push_back(static_cast<std::int32_t>(triangles[k][c]));
    }
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  arrays.add(as_field("connectivity", 1, connectivity));
  arrays.add(as_field("offsets", 1, offsets));
  // VTK's cell types: 1 is a vertex, 5 a triangle.
  arrays.add(as_field("types", 1, std::vector<std::uint8_t>(count, triangles.empty() ? 1 : 5)));
}

inline void require_fields(std::size_t size, std::span<const VtkField> fields) {
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const VtkField& field = fields[k];
    require(!field.name.empty(), "hmps: field ", k, " of a VTU file has no name; ParaView needs one");
    require(std::none_of(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(k),
                         [&](const VtkField& other) { return xml(other.name) == xml(field.name); }),
            "hmps: two fields of a VTU file are called ", xml(field.name), "; give each its own name");
    require((field.components == 1 || field.components == 3 || field.components == 9) &&
                (field.type == "Float32" || field.type == "Float64" || field.type == "Int32" || field.type == "UInt8"),
            "hmps: the field ", field.name, " of a VTU file has ", field.components, " components of the type '",
            field.type, "'; use vtk_field to make it");
    require(field.bytes.size() == size * field.width() * static_cast<std::size_t>(field.components), "hmps: the field ",
            field.name, " of a VTU file has ", field.size(), " particles but there are ", size,
            " positions; give both for the same particles");
  }
}

/// Throws `InputError` unless `names` belong to an integer field among `fields` and name each of its values.
inline void require_names(const VtkNames& names, std::span<const VtkField> fields) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const VtkField& field) {
    return field.name == names.field && field.type == "Int32";
  });
  require(found != fields.end(), "hmps: a VTU file has names for the values of ", names.field,
          ", which is not an integer field in it; name a field that is written too");
  for (std::size_t i = 0; i < found->bytes.size() / sizeof(std::int32_t); ++i) {
    std::int32_t value = 0;
    std::memcpy(&value, found->bytes.data() + i * sizeof(value), sizeof(value));
    require(value >= 0 && value < static_cast<std::int64_t>(names.names.size()), "hmps: number ", i, " of the field ",
            names.field, " of a VTU file is ", value, ", but there are ", names.names.size(),
            " names, for the values from 0 on; give a name for each value, and no negative values");
  }
}
}  // namespace detail

/// Points with fields as the bytes of a VTK file (.vtu, unstructured grid, version 1.0, appended raw data), which
/// ParaView, VTK and meshio read. `positions` are in m, with three components. Throws `InputError` for fields of
/// another size, without a name or with equal names, for triangles that name points that do not exist, for names that
/// belong to no integer field, do not name all of its values or are given twice, and for a time that is not finite.
[[nodiscard]] inline std::string vtu_text(const VtkField& positions, std::span<const VtkField> fields,
                                          const VtuSettings& settings = {}) {
  const std::size_t size = positions.size();
  const std::size_t cells = settings.triangles.empty() ? size : settings.triangles.size();
  detail::require(positions.components == 3, "hmps: the positions of a VTU file have ", positions.components,
                  " components; give three");
  detail::require(std::max(size, 3 * settings.triangles.size()) <= std::numeric_limits<std::int32_t>::max(),
                  "hmps: a VTU file of ", size, " points and ", settings.triangles.size(),
                  " triangles needs indices of more than 32 bits; write it in parts");
  detail::require(detail::is_finite(settings.time), "hmps: the time of a VTU file is ", settings.time,
                  " s; give a finite number");
  detail::require_fields(size, fields);
  detail::VtkArrays arrays;
  // Not one sum: there g++ 12 warns of bounds that it gets wrong.
  arrays.head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
  arrays.head += detail::byte_order;
  arrays.head +=
      "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">";
  arrays.head += detail::shortest(settings.time);
  arrays.head += "</DataArray>\n";
  for (const VtkNames& names : settings.names) {
    detail::require_names(names, fields);
    const auto is_same = [&](const VtkNames& other) { return other.field == names.field; };
    detail::require(std::count_if(settings.names.begin(), settings.names.end(), is_same) == 1, "hmps: the values of ",
                    names.field, " are named twice in a VTU file, and ParaView shows only one of the lists; join them");
    arrays.head += detail::vtk_words(names);
  }
  arrays.head += "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(size) + "\" NumberOfCells=\"" +
                 std::to_string(cells) + "\">\n<Points>\n";
  arrays.add(positions);
  arrays.head += "</Points>\n<Cells>\n";
  detail::add_cells(arrays, size, settings.triangles);
  arrays.head += "</Cells>\n<PointData>\n";
  for (const VtkField& field : fields) arrays.add(field);
  arrays.head += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return arrays.head + arrays.data + "\n</AppendedData>\n</VTKFile>\n";
}

/// Writes particles, or a surface if the settings have triangles, to the VTK file `path` (.vtu):
///
///     write_vtu("body.vtu", x, {{vtk_field("velocity", v), vtk_field("organ", scalars(organ))}},
///               {.time = t, .names = {{"organ", {"tongue", "palate"}}}});
///
/// Positions `x` are in m; in two dimensions z is zero. They are written in single precision, or in double where single
/// precision does not resolve 1e-4 of the spacing; see `position_field`. Of a name, bytes that are not UTF-8 become
/// question marks. The file is replaced as a whole: whoever reads it while it is
/// written finds the old one. Throws `InputError` as `vtu_text` does, for a position that is not finite, for a name
/// that does not end in .vtu, and, with the name and the reason, if the file cannot be written.
template <class T, int D>
void write_vtu(const std::filesystem::path& path, const VectorView<T, D>& x, const std::vector<VtkField>& fields = {},
               const VtuSettings& settings = {}) {
  detail::require(path.extension() == ".vtu", "hmps: ", path.string(),
                  " should be a VTK file of the kind .vtu; give it that ending, by which ParaView recognises it");
  require_finite(x, "the position");
  replace_file(path, vtu_text(position_field("position", x), fields, settings));
}

/// How a series of frames begins.
struct VtuSeriesSettings {
  /// The time in s at which a resumed run goes on: the frames up to this time that are listed already are kept, later
  /// ones are dropped. Without it, the series begins anew.
  std::optional<double> resume_at = {};
};

/// Frames of a run, which ParaView shows one after another: open `press.pvd` there.
///
///     VtuSeries frames("results/press.pvd");                       // makes the folder
///     VtuSeries frames("results/press.pvd", {.resume_at = t});     // goes on with it, from a checkpoint at time t
///     frames.add(t, x, {{vtk_field("velocity", v)}});              // writes results/press_00000.vtu, ...
///
/// Positions of a frame are in single or double precision, whichever it needs. The collection is complete at any
/// moment, so that a run can be watched while it goes on. Frames of an earlier run with the same name are overwritten
/// one by one, in a resumed run those that it dropped.
class VtuSeries {
 public:
  /// Begins the collection `path` (.pvd), or goes on with it. If it is not there yet, a resumed run begins it. A
  /// resumed run may write the frame at `resume_at` once more, in place of the one that was kept. Times of frames and
  /// `resume_at` are compared to 1e-8 of the latter: sums of up to ten million time steps differ by less from products,
  /// and the times of two steps by more.
  ///
  /// Throws `InputError` if its folder cannot be made or written to, for a name that does not end in .pvd, is not UTF-8
  /// or has control characters, for a `resume_at` that is not finite, and if the collection with which a resumed run
  /// should go on was damaged or is not from a series of this name.
  explicit VtuSeries(const std::filesystem::path& path, const VtuSeriesSettings& settings = {})
      : path_(std::filesystem::absolute(path)) {
    detail::require(path_.extension() == ".pvd", "hmps: ", path_.string(),
                    " should be a ParaView collection; end its name in .pvd");
    // The collection names its frames, so that ParaView would look for question marks.
    const std::string stem = path_.stem().string();
    detail::require(detail::xml_characters(stem) == stem, "hmps: the name of the ParaView collection ",
                    detail::printable(stem),
                    " has control characters or bytes that are not UTF-8; give it another name");
    if (settings.resume_at) resume(*settings.resume_at);
    std::error_code problem;
    std::filesystem::create_directories(path_.parent_path(), problem);
    detail::require(!problem, "hmps: cannot make the folder ", path_.parent_path().string(), ": ", problem.message(),
                    "; check its permissions");
    replace_file(path_, pvd_text(frames_));
  }

  /// Writes a frame, as `write_vtu` does, at `time` in s, and adds it to the collection. Throws `InputError` as that
  /// does, and for a time that is not later than that of the previous frame: ParaView would show only one of the two.
  /// Throws `StateError` if the collection is no longer as this series left it, for example because a second series
  /// writes to the same path.
  template <class T, int D>
  void add(double time, const VectorView<T, D>& x, const std::vector<VtkField>& fields = {},
           VtuSettings settings = {}) {
    // If the collection cannot be written, it stays as it is, and the frame can be added again.
    auto frames = frames_;
    if (!frames.empty() && std::abs(frames.back().first - time) <= again_) frames.pop_back();
    detail::require(frames.empty() || time > frames.back().first, "hmps: a frame of ", path_.string(), " at ", time,
                    " s follows one at ", frames.empty() ? 0.0 : frames.back().first,
                    " s; times must grow from frame to frame");
    if (std::error_code missing; std::filesystem::exists(path_, missing))
      if (detail::read_text(path_.string()) != pvd_text(frames_))
        throw StateError(detail::message("hmps: ", path_.string(), " has changed since this series wrote its frame ",
                                         frames_.size(),
                                         "; another series or program writes to it: give each its own path"));
    settings.time = time;
    const std::string name = file_of(frames.size());
    write_vtu(path_.parent_path() / name, x, fields, settings);
    frames.emplace_back(time, name);
    replace_file(path_, pvd_text(frames));
    frames_ = std::move(frames);
    again_ = -1;
  }

  /// Time in s and file of every frame.
  [[nodiscard]] const std::vector<std::pair<double, std::string>>& frames() const { return frames_; }

 private:
  [[nodiscard]] std::string file_of(std::size_t frame) const {
    const std::string number = std::to_string(frame);
    return path_.stem().string() + '_' + std::string(5 - std::min<std::size_t>(number.size(), 5), '0') + number +
           ".vtu";
  }

  /// Takes over the frames up to `time`.
  void resume(double time) {
    detail::require(detail::is_finite(time), "hmps: ", path_.string(), " is to be resumed at ", time,
                    " s; give the time of the checkpoint");
    std::error_code missing;
    if (!std::filesystem::is_regular_file(path_, missing)) return;
    const std::string text = detail::read_text(path_.string());
    for (const double listed : detail::pvd_times(text)) frames_.emplace_back(listed, file_of(frames_.size()));
    bool increases = frames_.empty() || detail::is_finite(frames_.front().first);
    for (std::size_t k = 1; k < frames_.size(); ++k)
      increases = increases && detail::is_finite(frames_[k].first) && frames_[k - 1].first < frames_[k].first;
    detail::require(
        text == pvd_text(frames_) && increases, "hmps: ", path_.string(),
        " cannot be resumed: it is damaged, or was not written by a series of this name; put back the file of the "
        "interrupted run, or leave out resume_at to begin anew");
    again_ = 1e-8 * std::abs(time);
    while (!frames_.empty() && frames_.back().first > time + again_) frames_.pop_back();  // the times increase
    if (!frames_.empty() && frames_.back().first < time - again_) again_ = -1;
  }

  std::filesystem::path path_;
  std::vector<std::pair<double, std::string>> frames_;
  double again_ = -1;  // s, by how much the next frame may differ from the last one that it replaces; -1: none
};

}  // namespace hmps::inline HMPS_ABI
