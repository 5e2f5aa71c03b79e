#pragma once
// Text columns, and texts of a result that all tables share.

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/text.h"
#include "result/result.h"

namespace clusterbench::report {

using Cells = std::vector<std::string>;  // one line: a mark, a name, then numbers

// The widest text of each column in characters; the first column is one character wide. All rows must have the same
// number of cells.
std::vector<std::size_t> widths_of(const std::vector<Cells>& rows);
// The first two columns left-aligned, numbers right-aligned.
std::string aligned(const Cells& cells, const std::vector<std::size_t>& widths);
std::string aligned_rows(const std::vector<Cells>& rows);

// printable() of a result's text: names in a scene file may contain terminal escapes.
inline std::string shown(const std::string& text) {
  return printable(text);
}
// A cell of a Markdown table, with markup escaped.
std::string markdown_cell(const std::string& text);
// Replaces a 95 % interval of times that is unknown for want of launches or rounds.
inline constexpr const char* k_unknown_interval = "unknown";
// The 95 % interval of a frame's time in percent of it, in all texts: half of its width, "3.5 %"; for a wide asymmetric
// interval both ends: "-14/+36 %".
std::string frame_interval_text(const result::Case& result_case);
std::string interval_text(const result::Time& time);  // likewise
// The requirements of an interval: "an interval takes ..."
std::string what_intervals_take();
// One number in a printf format.
std::string text(const char* format, double value);
// A share of lights in percent; a small one is never shown as 0: "0 %", "<0.01 %", "0.25 %".
std::string unlit_text(const std::optional<double>& share);
// Metres of a height: four digits; less than a micrometre is 0.
std::string height_text(double metres);
// A whole number unchanged, others with four digits or, from 100,000, six.
std::string amount_text(double value);
// A number in a chosen format; "-" without one.
std::string text_of(const std::optional<double>& value, const char* format, double scale = 1.0);
// Rounded bytes and counts: 831, 12.3k, 4.56M; "-" without a value.
std::string short_count(const std::optional<double>& count);

// "1920x1080"
template <class Number>
std::string viewport_text(const std::array<Number, 2>& viewport) {
  return std::to_string(viewport[0]) + "x" + std::to_string(viewport[1]);
}

// The readable name of a light structure: "packed", "no lists", "own lists".
std::string storage_name(const result::Case& result_case);
// The preset, if any, the assigner's label, the packing of lights unless it is float32, and the pre-cull.
std::string method_name(const result::Case& result_case);

struct NamedCase {
  std::string name;  // of the method, with the storage if the same method has several
  const result::Case* result_case;
};
// The part of a case that a table shows, as JSON; null if the case does not have it.
using PartOfCase = nlohmann::ordered_json (*)(const result::Case& result_case);
// The cases that have the part, without repetitions of method and part.
std::vector<NamedCase> distinct_cases(const std::vector<const result::Case*>& cases, PartOfCase part);

// ", machine 2", or "" if times are of one machine.
std::string machine_part(const result::Case& result_case);
// The common properties of a block of cases: camera, viewport and grid, and the machine if times are of several.
std::string block_of(const result::Case& result_case);
struct CaseBlock {
  std::string name;  // block_of() each case
  std::vector<const result::Case*> cases;
};
// The blocks of a scene in the order of its cases.
std::vector<CaseBlock> blocks_of(const std::vector<result::Case>& cases, const result::Scene& scene);

}  // namespace clusterbench::report
