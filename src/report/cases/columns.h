#pragma once
// Columns of text for people, and what all tables take from a result in the same way.

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/text.h"
#include "result/result.h"

namespace clusterbench::report {

using Cells = std::vector<std::string>;  // one line: a mark, a name, then numbers

// The widest text of each column in characters; the first column is one character wide. All rows have as many cells.
std::vector<std::size_t> widths_of(const std::vector<Cells>& rows);
// The first two columns to the left, numbers to the right.
std::string aligned(const Cells& cells, const std::vector<std::size_t>& widths);

// printable() of a result's text: names in a scene file may hold anything, a terminal must not obey them.
inline std::string shown(const std::string& text) {
  return printable(text);
}
// A cell of a Markdown table: nothing in it is taken for markup.
std::string markdown_cell(const std::string& text);
// In the place of a 95 % interval of times, where too few launches or rounds were measured to tell one.
inline constexpr const char* k_unknown_interval = "unknown";
// The 95 % interval of a frame's time in percent of it, the same wherever it is told: half of it, "3.5 %"; of a wide
// one, whose ends lie at different distances, both: "-14/+36 %".
std::string frame_interval_text(const result::Case& result_case);
// "an interval takes ..."
std::string what_intervals_take();
// One number by a printf format.
std::string text(const char* format, double value);
// A share of lights in percent; one that is small and not nothing never looks like nothing: "0 %", "<0.01 %", "0.25 %".
std::string unlit_text(const std::optional<double>& share);
// Metres of a height: four digits, and less than a micrometre is 0.
std::string height_text(double metres);
// A whole number as it is, others with four digits or, from 100,000, six.
std::string amount_text(double value);
// A number in a chosen format; "-" where there is none.
std::string text_of(const std::optional<double>& value, const char* format, double scale = 1.0);
// Bytes and counts as people say them: 831, 12.3k, 4.56M; "-" where there is none.
std::string short_count(const std::optional<double>& count);

// "1920x1080"
template <class Number>
std::string viewport_text(const std::array<Number, 2>& viewport) {
  return std::to_string(viewport[0]) + "x" + std::to_string(viewport[1]);
}

// What its lights are kept in, as people read it: "packed", "no lists", "own lists".
std::string storage_name(const result::Case& result_case);
// The preset if the case is of one, the assigner's label, how its lights are packed where that is not float32, and what
// culls them before.
std::string method_name(const result::Case& result_case);

struct NamedCase {
  std::string name;  // the method's, with the storage where the same method has others
  const result::Case* result_case;
};
// What a table shows of a case, as JSON; null where the case has nothing of it.
using PartOfCase = nlohmann::ordered_json (*)(const result::Case& result_case);
// The cases of a scene's block that have the part, once where method and part are the same.
std::vector<NamedCase> distinct_cases(const std::vector<result::Case>& cases, const result::Scene& scene,
                                      const std::string& block, PartOfCase part);

// What cases of one block have in common: camera, viewport and grid.
std::string block_of(const result::Case& result_case);
// The blocks of a scene in the order of its cases.
std::vector<std::string> blocks_of(const std::vector<result::Case>& cases, const result::Scene& scene);

}  // namespace clusterbench::report
