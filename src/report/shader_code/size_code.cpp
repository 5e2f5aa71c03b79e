#include "report/shader_code/size_code.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/shader_code/list_code.h"
#include "report/shader_code/lookup_code.h"
#include "report/shader_code/lookup_constants.h"
#include "report/sizing/size_words.h"

namespace clusterbench::report {
namespace {

// A name from a scene file within one comment line: it must not end the line or continue it, not even by a trigraph.
std::string comment_text(std::string name) {
  for (char& c : name)
    if (std::iscntrl(static_cast<unsigned char>(c)) != 0 || c == '\\') c = '_';
  for (std::size_t at = name.find("?\?/"); at != std::string::npos; at = name.find("?\?/")) name[at + 2] = '_';
  return name;
}

std::string comment_line(const std::string& text) {
  return "// " + comment_text(text) + "\n";
}

std::string frames_text(const FrameSpread& spread) {
  return "min " + std::to_string(spread.min) + ", median " + std::to_string(spread.p50) + ", p90 " +
         std::to_string(spread.p90) + ", p99 " + std::to_string(spread.p99) + ", max " + std::to_string(spread.max) +
         (spread.is_exact ? "" : " (at most: of long paths several frames are one number)");
}

std::string buffer_comment(const SizedBuffer& buffer, const SizedStructure& structure, const AllocationRules& rules) {
  const std::string capacity = std::to_string(buffer.capacity);
  std::string out = comment_line("  " + buffer.name + ": high water " + std::to_string(buffer.high_water) + " in " +
                                 worst_text(buffer) + "; " + share_text(buffer.high_water, buffer.theoretical_max) +
                                 " of the theoretical " + std::to_string(buffer.theoretical_max));
  const bool differs = buffer.spread && buffer.spread->min != buffer.spread->max;
  if (differs && buffer.groups.empty()) out += comment_line("    frames    " + frames_text(*buffer.spread));
  for (const FrameGroup& group : buffer.groups)
    if (group.spread)
      out += comment_line("    frames    of " + joined(group.cameras, " + ") + ": " + frames_text(*group.spread));
  out += comment_line("    allocate  " + capacity + " elements of " + number_of(buffer.element_bytes, "byte") + " (" +
                      (buffer.is_all() ? "all that there can be" : rule_text(buffer, rules)) +
                      "): " + std::to_string(buffer.bytes) + " bytes, " +
                      std::to_string(buffer.double_buffered_bytes()) + " double-buffered");
  for (const MarkLine& line : mark_lines(buffer, structure))
    out += comment_line("    " + line.label + "  " + line.text);
  return out;
}

std::string cameras_text(const SizedStructure& structure) {
  std::vector<std::string> cameras;
  for (const result::Case* result_case : structure.cases)
    if (std::ranges::find(cameras, result_case->camera) == cameras.end()) cameras.push_back(result_case->camera);
  std::string out = (cameras.size() == 1 ? "camera " : "cameras ") + joined(cameras);
  for (const std::vector<std::string>& view : structure.views)
    out += "; in one buffer in one frame: " + joined(view, " + ");
  return out;
}

std::string structure_comment(const SizedStructure& structure) {
  std::string out = comment_line(structure.name) + comment_line("  " + cameras_text(structure));
  std::vector<std::string> viewports;
  for (const result::Case* result_case : structure.cases)
    if (const std::string one = viewport_text(result_case->viewport);
        std::ranges::find(viewports, one) == viewports.end())
      viewports.push_back(one);
  if (viewports.size() > 1) out += comment_line("  viewports " + joined(viewports));
  if (!structure.choice.empty()) out += comment_line("  " + structure.choice);
  if (const std::string unseen = nothing_seen_text(structure); !unseen.empty()) out += comment_line("  " + unseen);
  for (const std::string& note : grid_notes(structure)) out += comment_line("  grid: " + note);
  for (const std::string& note : limit_notes(structure)) out += comment_line("  LIMIT: " + note);
  for (const std::string& line : guest_lines(structure)) out += comment_line("  " + line);
  if (const std::string dropped = dropped_text(structure); !dropped.empty())
    out += comment_line("  OVERFLOW: " + dropped + ", for which there is room below");
  return out;
}

std::string cpp_buffer(const SizedBuffer& buffer, const std::string& name) {
  return "inline constexpr LightBuffer " + name + "{\"" + name + "\", " + std::to_string(buffer.capacity) + "u, " +
         std::to_string(buffer.warn_above) + "u, " + std::to_string(buffer.bytes) + "u, " +
         std::to_string(buffer.element_bytes) + "u};\n";
}

// Counts beyond 32 bits appear only in the comment.
std::string shader_buffer(const SizedBuffer& buffer, const std::string& name, const char* type) {
  const auto line = [&](const char* what, std::uint64_t value) {
    if (value > std::numeric_limits<std::uint32_t>::max()) return std::string();
    return type + (" " + name) + "_" + what + " = " + std::to_string(value) + "u;\n";
  };
  return line("capacity", buffer.capacity) + line("warn_above", buffer.warn_above) + line("bytes", buffer.bytes) +
         line("element_bytes", buffer.element_bytes);
}

std::string lookup_text(const NamedLookup& lookup, SizeLanguage language, bool is_only_one) {
  const result::Case& result_case = *lookup.cases.front();
  std::string out;
  if (!is_only_one)
    for (const result::Case* of_camera : lookup.cases)
      out += comment_line("  lookup of camera " + of_camera->camera + " at " + viewport_text(of_camera->viewport));
  if (const std::string note = lookup_note(result_case); !note.empty()) out += comment_line("  lookup: " + note);
  const std::vector<LookupConstant> constants = lookup_constants(result_case);
  if (language == SizeLanguage::cpp) return out + lookup_cpp(lookup.name, constants);
  if (language == SizeLanguage::hlsl)
    return out + lookup_hlsl(lookup.name, constants) + lookup_function_hlsl(lookup.name, result_case);
  return out + lookup_glsl(lookup.name, constants) + lookup_function_glsl(lookup.name, result_case);
}

std::string structure_code(const NamedStructure& named, SizeLanguage language, const AllocationRules& rules,
                           int& slot) {
  const SizedStructure& structure = named.structure;
  std::string out = structure_comment(structure);
  for (std::size_t i = 0; i < structure.buffers.size(); ++i) {
    const SizedBuffer& buffer = structure.buffers[i];
    out += buffer_comment(buffer, structure, rules);
    out += language == SizeLanguage::cpp
               ? cpp_buffer(buffer, named.buffers[i])
               : shader_buffer(buffer, named.buffers[i],
                               language == SizeLanguage::hlsl ? "static const uint" : "const uint");
  }
  for (const NamedLookup& lookup : named.lookups) out += lookup_text(lookup, language, named.lookups.size() == 1);
  if (language != SizeLanguage::cpp)
    out += list_code(named, language == SizeLanguage::hlsl ? ShaderLanguage::hlsl : ShaderLanguage::glsl, slot);
  return out + "\n";
}

// Fragment shaders of OpenGL ES have no default.
constexpr const char* k_es_precision = R"(#ifdef GL_ES
precision highp float;
precision highp int;
#endif

)";

constexpr const char* k_title =
    "// Light-list allocation, measured by clusterbench. Measure again when levels, lights or the clustering change.\n";

constexpr const char* k_header_start = R"(
#include <cassert>
#include <cstdint>
#include <cstdio>

namespace light_lists {

struct LightBuffer {
  const char* name;
  std::uint64_t capacity;       // elements to allocate
  std::uint64_t warn_above;     // check() warns of a frame that needs more elements than this
  std::uint64_t bytes;          // of the allocation
  std::uint64_t element_bytes;
};

)";

constexpr const char* k_header_end =
    R"(// Call once per frame with the number of elements that the frame needs. Keeps the largest ever; warns once per new
// largest number above the warning level; asserts before the allocation is overrun.
inline void check(const LightBuffer& buffer, std::uint64_t needed, std::uint64_t& largest_ever) {
  if (needed > largest_ever) {
    largest_ever = needed;
    if (needed > buffer.warn_above)
      std::fprintf(stderr, "%s: %llu of %llu elements in use; raise the allocation\n", buffer.name,
                   static_cast<unsigned long long>(needed), static_cast<unsigned long long>(buffer.capacity));
  }
  assert(needed <= buffer.capacity && "light lists overflow their allocation");
}

}  // namespace light_lists
)";

// The include guard of a shader's file.
std::string guard_text(SizeLanguage language, const std::vector<NamedStructure>& structures) {
  const std::string guard = (structures.empty() ? std::string("light_lists") : structures.front().name) + "_included";
  return (language == SizeLanguage::glsl ? "// For shaders of #version 430 or later, or 310 es.\n" : "") +
         ("#ifndef " + guard + "\n#define " + guard + "\n\n");
}

}  // namespace

std::string size_code(SizeLanguage language, const std::vector<NamedStructure>& structures, const std::string& remark,
                      const AllocationRules& rules) {
  const bool is_cpp = language == SizeLanguage::cpp;
  std::string out = (is_cpp ? std::string("#pragma once\n") : std::string()) + k_title;
  if (!remark.empty()) out += comment_line(remark);
  out += is_cpp ? k_header_start : "\n";
  if (!is_cpp) out += guard_text(language, structures);
  if (language == SizeLanguage::glsl) out += k_es_precision;
  int slot = 0;
  for (const NamedStructure& named : structures) out += structure_code(named, language, rules, slot);
  return out + (is_cpp ? k_header_end : "#endif\n");
}

}  // namespace clusterbench::report
