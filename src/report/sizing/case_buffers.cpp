#include "report/sizing/case_buffers.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/sizing/counts.h"

namespace clusterbench::report {
namespace {

PathNeed path_need(const result::Case& result_case, const result::Buffer& buffer) {
  PathNeed path{result_case.camera, 1, {}};
  if (const std::optional<result::CameraPath>& along = result_case.camera_path)
    path.span_s = {along->from_s, along->to_s};
  if (buffer.along_path) {
    path.frames_per_entry = std::max<std::uint64_t>(1, buffer.along_path->frames_per_entry);
    path.elements = buffer.along_path->elements;
  } else if (result_case.frames > 0) {
    path.frames_per_entry = result_case.frames;
    path.elements = {buffer.high_water};
  }
  return path;
}

std::vector<CaseBuffer> buffers_of_earlier_version(const result::Case& result_case) {
  const result::Buffers& buffers = result_case.buffers;
  CaseBuffer indices;
  indices.name = "entries";
  indices.element_bytes = std::max<std::uint64_t>(1, buffers.index_bits / 8);
  indices.high_water = buffers.index_entries.high_water;
  indices.theoretical_max = buffers.index_entries.theoretical_max;
  indices.worst_frame = buffers.worst_frame;
  indices.worst_cell = buffers.worst_cell;
  indices.path.camera = result_case.camera;
  CaseBuffer headers = indices;
  headers.name = "header_bytes";
  headers.element_bytes = 1;
  headers.high_water = headers.theoretical_max = buffers.header_bytes;
  return {indices, headers};
}

// The number of entries of the paths with more than one; 0 if they differ, or some are unknown.
std::size_t common_entries(const std::vector<CaseBuffer>& all) {
  std::size_t entries = 1;
  std::uint64_t per_entry = 0;
  for (const CaseBuffer& one : all) {
    if (one.path.elements.empty()) return 0;
    if (one.path.is_same_in_all_frames()) continue;
    if (per_entry != 0 && (entries != one.path.elements.size() || per_entry != one.path.frames_per_entry)) return 0;
    entries = one.path.elements.size();
    per_entry = one.path.frames_per_entry;
  }
  return entries;
}

// Why frames of the same index cannot be added, for cameras whose frames differ; "" if they can.
std::string why_not_by_frame(const std::vector<CaseBuffer>& cameras) {
  std::vector<std::string> frames, spans;
  for (const CaseBuffer& one : cameras) {
    if (one.path.elements.empty()) return "the result has no frames of some";
    if (one.path.is_same_in_all_frames()) continue;
    frames.push_back(std::to_string(one.path.elements.size() * one.path.frames_per_entry));
    if (const auto& span = one.path.span_s)
      spans.push_back(text("%.6g s", span->first) + text(" to %.6g s", span->second));
  }
  const bool differs = std::ranges::adjacent_find(spans, std::ranges::not_equal_to()) != spans.end();
  const std::string spans_text = differs ? "go from " + joined(spans, " and from ") : "";
  if (common_entries(cameras) == 0)
    return "their paths have " + joined(frames, " and ") + " frames" + (differs ? " and " + spans_text : "");
  return differs ? "their paths " + spans_text : "";
}

std::uint64_t need_at(const CaseBuffer& one, std::size_t entry) {
  return one.path.is_same_in_all_frames() ? one.path.elements.front() : one.path.elements[entry];
}

// The need of these cameras in one frame, where camera i needs needs[i].
std::uint64_t together(const std::vector<CaseBuffer>& cameras, const std::vector<std::uint64_t>& needs) {
  const bool has_room_per_cell = std::ranges::any_of(cameras, [](const CaseBuffer& one) { return one.step > 1; });
  std::uint64_t sum = 0, cells = 0, longest = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    sum = sum_of_counts(sum, needs[i]);
    cells = sum_of_counts(cells, cameras[i].step);
    longest = std::max(longest, needs[i] / cameras[i].step);
  }
  return has_room_per_cell ? product_of_counts(cells, longest) : sum;
}

void set_path(CaseBuffer& out, const std::vector<CaseBuffer>& all, std::vector<std::uint64_t> elements) {
  const auto most = std::ranges::max_element(elements);
  out.high_water = *most;
  for (const CaseBuffer& one : all)
    if (elements.size() == 1 || !one.path.is_same_in_all_frames())
      out.path.frames_per_entry = one.path.frames_per_entry;
  out.worst_frame =
      elements.size() == 1 ? 0 : static_cast<std::uint64_t>(most - elements.begin()) * out.path.frames_per_entry;
  out.path.elements = std::move(elements);
}

std::string joined_cameras(const std::vector<CaseBuffer>& cameras) {
  std::string out;
  for (const CaseBuffer& one : cameras) out += (out.empty() ? "" : "+") + one.path.camera;
  return out;
}

}  // namespace

std::vector<CaseBuffer> buffers_of(const result::Case& result_case) {
  if (!result_case.buffers.each) return buffers_of_earlier_version(result_case);
  std::vector<CaseBuffer> out;
  for (const result::Buffer& buffer : *result_case.buffers.each)
    out.push_back({buffer.name, std::max<std::uint64_t>(1, buffer.element_bytes),
                   std::max<std::uint64_t>(1, buffer.step), buffer.high_water, buffer.theoretical_max,
                   buffer.worst_frame, buffer.worst_cell, path_need(result_case, buffer)});
  return out;
}

CaseBuffer in_one_frame(const std::vector<CaseBuffer>& cameras) {
  CaseBuffer out = cameras.front();
  if (cameras.size() == 1) return out;
  out.path = {joined_cameras(cameras), 1, {}};
  out.worst_cell.reset();
  out.step = out.theoretical_max = 0;
  std::vector<std::uint64_t> marks;
  for (const CaseBuffer& one : cameras) {
    out.element_bytes = std::max(out.element_bytes, one.element_bytes);
    out.step = sum_of_counts(out.step, one.step);
    out.theoretical_max = sum_of_counts(out.theoretical_max, one.theoretical_max);
    marks.push_back(one.high_water);
  }
  if (std::ranges::all_of(cameras, [](const CaseBuffer& one) { return one.step == 1; })) out.step = 1;
  out.apart = together(cameras, marks);
  out.why_sum = why_not_by_frame(cameras);
  if (!out.why_sum.empty()) {
    out.high_water = out.apart;
    out.worst_frame = 0;
    return out;
  }
  const std::size_t entries = common_entries(cameras);
  const auto is_moving_of_no_time = [](const CaseBuffer& one) {
    return !one.path.is_same_in_all_frames() && !one.path.span_s;
  };
  out.has_times = std::ranges::none_of(cameras, is_moving_of_no_time);
  std::vector<std::uint64_t> elements(entries);
  for (std::size_t entry = 0; entry < entries; ++entry) {
    std::vector<std::uint64_t> needs;
    for (const CaseBuffer& one : cameras) needs.push_back(need_at(one, entry));
    elements[entry] = together(cameras, needs);
  }
  set_path(out, cameras, std::move(elements));
  out.is_upper_bound = entries > 1 && out.path.frames_per_entry > 1;
  return out;
}

CaseBuffer over_viewports(const std::vector<CaseBuffer>& viewports) {
  CaseBuffer out = *std::ranges::max_element(viewports, {}, &CaseBuffer::high_water);
  for (const CaseBuffer& one : viewports) {
    out.element_bytes = std::max(out.element_bytes, one.element_bytes);
    out.theoretical_max = std::max(out.theoretical_max, one.theoretical_max);
    out.apart = std::max(out.apart, one.apart);
  }
  const std::size_t entries = common_entries(viewports);
  if (viewports.size() == 1 || entries == 0) return out;
  std::vector<std::uint64_t> elements(entries, 0);
  for (const CaseBuffer& one : viewports)
    for (std::size_t entry = 0; entry < entries; ++entry)
      elements[entry] = std::max(elements[entry], need_at(one, entry));
  const std::uint64_t worst_frame = out.worst_frame;
  set_path(out, viewports, std::move(elements));
  out.worst_frame = worst_frame;
  return out;
}

}  // namespace clusterbench::report
