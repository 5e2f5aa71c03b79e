#include "report/allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"
#include "report/json_values.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t k_largest_count = std::numeric_limits<std::uint64_t>::max();

// What does not fit into 64 bits is as much as does: a result that was changed by hand may say anything.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > k_largest_count / b ? k_largest_count : a * b;
}
std::uint64_t as_count(double value) {
  constexpr double k_end = 18446744073709551616.0;  // 2^64
  return value >= k_end ? k_largest_count : static_cast<std::uint64_t>(value);
}
std::uint64_t up_to_multiple(std::uint64_t value, std::uint64_t step) {
  const std::uint64_t over = value % step;
  return over == 0 || value > k_largest_count - (step - over) ? value : value + (step - over);
}

std::uint64_t rounded_bytes(std::uint64_t bytes, Rounding rounding) {
  constexpr std::uint64_t k_page = 4096, k_largest_power = std::uint64_t{1} << 63;
  if (bytes == 0 || rounding == Rounding::none) return bytes;
  if (rounding == Rounding::page) return up_to_multiple(bytes, k_page);
  std::uint64_t power = 1;
  while (power < bytes && power < k_largest_power) power *= 2;
  return std::max(power, bytes);
}

void allocate(SizedBuffer& buffer, std::uint64_t step, const AllocationRules& rules) {
  const double wanted = std::ceil(static_cast<double>(buffer.high_water) * rules.margin);
  const std::uint64_t whole = up_to_multiple(std::max(buffer.high_water, as_count(wanted)), step);
  const std::uint64_t capacity = std::min(whole, std::max(buffer.theoretical_max, buffer.high_water));
  buffer.bytes = rounded_bytes(times(capacity, buffer.element_bytes), rules.rounding);
  const std::uint64_t fitting = buffer.bytes / buffer.element_bytes / step * step;
  buffer.capacity = std::max(capacity, std::min(fitting, buffer.theoretical_max));
  buffer.warn_above =
      buffer.is_all() ? buffer.capacity : as_count(std::floor(static_cast<double>(buffer.capacity) * rules.warn_at));
}

// The value of so many frames.
struct Weighed {
  std::uint64_t value, frames;
};

std::uint64_t at_rank(const std::vector<Weighed>& ascending, double share, double frames) {
  const double rank = std::ceil(share * frames);
  double counted = 0.0;
  for (const Weighed& weighed : ascending) {
    counted += static_cast<double>(weighed.frames);
    if (counted >= rank) return weighed.value;
  }
  return ascending.back().value;
}

std::optional<FrameSpread> spread_of(const std::vector<PathNeed>& paths) {
  std::vector<Weighed> all;
  double frames = 0.0;
  FrameSpread spread;
  for (const PathNeed& path : paths) {
    if (path.frames_per_entry != 1 && path.elements.size() > 1) spread.is_exact = false;
    for (const std::uint64_t value : path.elements) {
      all.push_back({value, path.frames_per_entry});
      frames += static_cast<double>(path.frames_per_entry);
    }
  }
  if (all.empty()) return {};
  std::ranges::sort(all, {}, &Weighed::value);
  spread.min = all.front().value;
  spread.max = all.back().value;
  spread.p50 = at_rank(all, 0.5, frames);
  spread.p90 = at_rank(all, 0.9, frames);
  spread.p99 = at_rank(all, 0.99, frames);
  return spread;
}

std::uint64_t count_at(const Json& from, const char* key) {
  return from[key].get<std::uint64_t>();
}

// A buffer of one camera's case, as the result has it.
struct CaseBuffer {
  std::string name;
  std::uint64_t element_bytes = 1, step = 1, high_water = 0, theoretical_max = 0, worst_frame = 0;
  Json worst_cell;
  PathNeed path;
};

PathNeed path_need(const Json& result_case, const Json& buffer) {
  PathNeed path{result_case["camera"].get<std::string>(), 1, {}};
  if (const Json* along = value_at(buffer, "/along_path")) {
    path.frames_per_entry = std::max<std::uint64_t>(1, count_at(*along, "frames_per_entry"));
    path.elements = (*along)["elements"].get<std::vector<std::uint64_t>>();
  } else if (const std::uint64_t frames = count_at(result_case, "frames"); frames > 0) {
    path.frames_per_entry = frames;
    path.elements = {count_at(buffer, "high_water")};
  }
  return path;
}

Json cell_of(const Json& from) {
  const Json* cell = value_at(from, "/worst_cell");
  return cell == nullptr ? Json() : *cell;
}

std::vector<CaseBuffer> buffers_of_earlier_version(const Json& result_case) {
  const Json &buffers = result_case["buffers"], &entries = buffers["index_entries"];
  CaseBuffer indices;
  indices.name = "entries";
  indices.element_bytes = std::max<std::uint64_t>(1, count_at(buffers, "index_bits") / 8);
  indices.high_water = count_at(entries, "high_water");
  indices.theoretical_max = count_at(entries, "theoretical_max");
  indices.worst_frame = count_at(buffers, "worst_frame");
  indices.worst_cell = cell_of(buffers);
  indices.path.camera = result_case["camera"].get<std::string>();
  CaseBuffer headers = indices;
  headers.name = "header_bytes";
  headers.element_bytes = 1;
  headers.high_water = headers.theoretical_max = count_at(buffers, "header_bytes");
  return {indices, headers};
}

std::vector<CaseBuffer> buffers_of(const Json& result_case) {
  const Json* each = value_at(result_case, "/buffers/each");
  if (each == nullptr) return buffers_of_earlier_version(result_case);
  std::vector<CaseBuffer> out;
  for (const Json& buffer : *each)
    out.push_back({buffer["name"].get<std::string>(), std::max<std::uint64_t>(1, count_at(buffer, "element_bytes")),
                   std::max<std::uint64_t>(1, count_at(buffer, "step")), count_at(buffer, "high_water"),
                   count_at(buffer, "theoretical_max"), count_at(buffer, "worst_frame"), cell_of(buffer),
                   path_need(result_case, buffer)});
  return out;
}

// Into what the earlier cameras need.
void add(SizedBuffer& buffer, std::uint64_t& step, const CaseBuffer& next) {
  if (buffer.paths.empty() || next.high_water > buffer.high_water) {
    buffer.high_water = next.high_water;
    buffer.worst_camera = next.path.camera;
    buffer.worst_frame = next.worst_frame;
    buffer.worst_cell = next.worst_cell;
    step = next.step;
  }
  buffer.theoretical_max = std::max(buffer.theoretical_max, next.theoretical_max);
  buffer.element_bytes = std::max(buffer.element_bytes, next.element_bytes);
  buffer.paths.push_back(next.path);
}

void size_buffers(SizedStructure& structure, const AllocationRules& rules) {
  std::vector<std::uint64_t> steps;
  for (const Json* result_case : structure.cases)
    for (const CaseBuffer& next : buffers_of(*result_case)) {
      auto known = std::ranges::find(structure.buffers, next.name, &SizedBuffer::name);
      if (known == structure.buffers.end()) {
        known = structure.buffers.insert(known, SizedBuffer{});
        known->name = next.name;
        known->element_bytes = next.element_bytes;
        steps.push_back(1);
      }
      add(*known, steps[static_cast<std::size_t>(known - structure.buffers.begin())], next);
    }
  for (std::size_t i = 0; i < structure.buffers.size(); ++i) {
    allocate(structure.buffers[i], steps[i], rules);
    structure.buffers[i].spread = spread_of(structure.buffers[i].paths);
  }
}

std::vector<const Json*> matching_cases(const Json& cases, const std::string& filter) {
  std::vector<const Json*> out;
  const Pattern pattern(filter, "--filter");
  for (const Json& result_case : cases)
    if (pattern.is_in(result_case["name"].get_ref<const std::string&>())) out.push_back(&result_case);
  if (out.empty() && !cases.empty())
    throw Error("", "--filter",
                "'" + filter + "' matches none of " + number_of(cases.size(), "case") + "; one of them is '" +
                    cases[0]["name"].get<std::string>() + "'");
  return out;
}

// A case's name without its camera, and of that the scene and the grid. Names that are not made like that are taken as
// they are.
struct Names {
  std::string structure, group;
};

Names names_of(const Json& result_case) {
  const auto name = result_case["name"].get<std::string>(), scene = result_case["scene"].get<std::string>();
  const std::string prefix = scene + "/" + result_case["camera"].get<std::string>() + "/";
  if (!name.starts_with(prefix)) return {name, name};
  const std::string rest = name.substr(prefix.size());
  return {scene + "/" + rest, scene + "/" + rest.substr(0, rest.find('/'))};
}

bool has_camera(const SizedStructure& structure, const Json& camera) {
  return std::ranges::any_of(structure.cases,
                             [&](const Json* result_case) { return (*result_case)["camera"] == camera; });
}

}  // namespace

std::uint64_t SizedBuffer::double_buffered_bytes() const {
  return times(2, bytes);
}

std::uint64_t SizedStructure::bytes() const {
  std::uint64_t sum = 0;
  for (const SizedBuffer& buffer : buffers)
    sum = buffer.bytes > k_largest_count - sum ? k_largest_count : sum + buffer.bytes;
  return sum;
}

std::vector<SizedStructure> sized_structures(const Json& result, const std::string& filter,
                                             const AllocationRules& rules) {
  std::vector<SizedStructure> out;
  for (const Json* result_case : matching_cases(result["cases"], filter)) {
    const Names names = names_of(*result_case);
    // The same camera again is another structure whose name is the same.
    auto known = std::ranges::find_if(out, [&](const SizedStructure& sized) {
      return sized.name == names.structure && !has_camera(sized, (*result_case)["camera"]);
    });
    if (known == out.end()) known = out.insert(known, {names.structure, names.group, {}, {}});
    known->cases.push_back(result_case);
  }
  for (SizedStructure& structure : out) size_buffers(structure, rules);
  return out;
}

}  // namespace clusterbench::report
