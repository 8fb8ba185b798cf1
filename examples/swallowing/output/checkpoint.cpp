// SPDX-License-Identifier: MIT
#include "output/checkpoint.hpp"

#include <algorithm>
#include <string_view>

#include "../../common/checksum.hpp"
#include "../../common/error.hpp"

namespace swallowing {

namespace {

constexpr std::string_view magic = "hmps swallowing checkpoint\n";
constexpr std::uint64_t version = 3;
/// Reads back as another number if the byte order differs.
constexpr std::uint64_t byte_order = 0x0102030405060708;

/// Includes the length, because the last word of `bytes` is padded with zeros.
[[nodiscard]] std::uint64_t checksum(std::string_view bytes) {
  return examples::checksum(bytes, examples::add_to_checksum(examples::checksum_of_nothing, bytes.size()));
}

struct Writer {
  std::string bytes;
  template <class T>
  void number(T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void text(std::string_view value) {
    number<std::uint64_t>(value.size());
    bytes += value;
  }
};

struct Reader {
  std::string_view bytes;
  template <class T>
  [[nodiscard]] T number() {
    T value{};
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  [[nodiscard]] std::string text() { return std::string(take(number<std::uint64_t>())); }
  [[nodiscard]] std::string_view take(std::uint64_t size) {
    examples::require(size <= bytes.size(), "the checkpoint ends too early");
    const std::string_view part = bytes.substr(0, size);
    bytes.remove_prefix(size);
    return part;
  }
};

}  // namespace

void Checkpoint::save(const std::filesystem::path& path) const {
  Writer out;
  out.bytes = magic;
  out.number(version);
  out.number(byte_order);
  out.number(time);
  out.number(step);
  out.number<std::uint64_t>(settings.size());
  for (const auto& [name, value] : settings) {
    out.text(name);
    out.text(value);
  }
  out.number<std::uint64_t>(arrays_.size());
  for (const Array& array : arrays_) {
    out.text(array.name);
    out.number(array.width);
    out.text(array.bytes);
  }
  out.number(checksum(out.bytes));
  examples::write_atomically(path, out.bytes);
}

std::optional<Checkpoint> Checkpoint::load(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::string bytes = examples::read_file(path);
  const std::string remedy = "; remove it, or start anew without --resume";
  examples::require(bytes.starts_with(magic) && bytes.size() > magic.size() + 24, path.string(),
                    " is not a checkpoint of this program", remedy);
  Reader in{std::string_view(bytes).substr(magic.size())};
  const auto found = in.number<std::uint64_t>();
  examples::require(found == version, path.string(), " is a checkpoint of version ", found,
                    ", this program reads version ", version, remedy);
  examples::require(in.number<std::uint64_t>() == byte_order, path.string(),
                    " was written on a machine with another byte order", remedy);
  const std::string_view body = std::string_view(bytes).substr(0, bytes.size() - 8);
  std::uint64_t expected = 0;
  std::memcpy(&expected, bytes.data() + body.size(), 8);
  examples::require(checksum(body) == expected, path.string(), " is damaged: its checksum does not match", remedy);

  Checkpoint checkpoint;
  checkpoint.time = in.number<double>();
  checkpoint.step = in.number<std::uint64_t>();
  for (auto count = in.number<std::uint64_t>(); count > 0; --count) {
    std::string name = in.text();
    checkpoint.settings.emplace_back(std::move(name), in.text());
  }
  for (auto count = in.number<std::uint64_t>(); count > 0; --count) {
    Array array;
    array.name = in.text();
    array.width = in.number<std::uint64_t>();
    array.bytes = in.text();
    examples::require(array.width > 0 && array.bytes.size() % array.width == 0, path.string(),
                      " is damaged: its array ", array.name, " has ", array.bytes.size(), " bytes in elements of ",
                      array.width, remedy);
    checkpoint.arrays_.push_back(std::move(array));
  }
  return checkpoint;
}

const Checkpoint::Array& Checkpoint::find(const std::string& name) const {
  const auto found = std::find_if(arrays_.begin(), arrays_.end(), [&](const Array& a) { return a.name == name; });
  examples::require(found != arrays_.end(), "the checkpoint does not hold ", name,
                    "; it was written by another version of this program: start anew without --resume");
  return *found;
}

std::optional<std::string> first_difference(const RunSettings& other, const RunSettings& settings) {
  const auto value_in = [](const RunSettings& list, const std::string& name) {
    const auto found = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.first == name; });
    return found == list.end() ? std::string("not set") : found->second;
  };
  for (const RunSettings* list : {&settings, &other})
    for (const auto& entry : *list) {
      const std::string& name = entry.first;
      const std::string theirs = value_in(other, name), ours = value_in(settings, name);
      if (theirs != ours) return name + ' ' + theirs + " in place of " + ours;
    }
  return std::nullopt;
}

void require_same_settings(const Checkpoint& checkpoint, const RunSettings& settings, const std::filesystem::path& path,
                           bool same_motion) {
  const auto compared = [same_motion](RunSettings list) {
    if (same_motion) std::erase_if(list, [](const auto& entry) { return entry.first.starts_with(track_setting); });
    return list;
  };
  const auto difference = first_difference(compared(checkpoint.settings), compared(settings));
  examples::require(!difference, path.string(), " was written by a run with ", difference.value_or(""),
                    ", which this one has; resume with the same settings, or start anew without --resume");
}

}  // namespace swallowing
