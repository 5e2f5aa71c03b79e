#include "report/shader_code/list_code.h"

#include <algorithm>

#include "report/sizing/allocation.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

// All code is GLSL first, with P_ for the structure's name, @name@ for the parts that differ, and in_language() for
// both languages.
constexpr const char* k_packed = R"(struct P_list { uint first, lights, points, spots, boxes; };
P_list P_list_of(int cell) {
  P_list list;
  list.first = list.lights = list.points = list.spots = list.boxes = 0u;
  if (cell < 0) return list;
@slot@  list.first = P_headers_word(at);
@counts@  list.lights = list.points + list.spots + list.boxes;
  return list;
}
uint P_index_at(P_list list, uint n) {
  uint entry = list.first + n;
  return @entry@;
}
)";
constexpr const char* k_dense_slot = "  uint at = uint(cell) * @words@u;\n";
constexpr const char* k_sparse_slot =
    R"(  uint mask = P_header_blocks_word((uint(cell) >> 5u) * 2u), bit = 1u << (uint(cell) & 31u);
  if ((mask & bit) == 0u) return list;
  uint at = (P_header_blocks_word((uint(cell) >> 5u) * 2u + 1u) + uint(bitCount(mask & (bit - 1u)))) * @words@u;
)";
constexpr const char* k_narrow_counts = R"(  list.points = P_headers_word(at + 1u) & 0xffffu;
  list.spots = P_headers_word(at + 1u) >> 16u;
)";
constexpr const char* k_wide_counts = R"(  list.points = P_headers_word(at + 1u);
  list.spots = P_headers_word(at + 2u);
)";

constexpr const char* k_fixed = R"(@constant@ P_lights_per_cell = @room@u;
struct P_list { uint first, lights; };
P_list P_list_of(int cell) {
  P_list list;
  list.first = cell < 0 ? 0u : uint(cell) * P_lights_per_cell;
  list.lights = cell < 0 ? 0u : min(P_counts_word(uint(cell)), P_lights_per_cell);
  return list;
}
uint P_index_at(P_list list, uint n) {
  uint entry = list.first + n;
  return @entry@;
}
)";

// Without counts.
constexpr const char* k_ended = R"(@constant@ P_lights_per_cell = @room@u;
@marked@ P_end_mark = @end@u;  // the first index that is no light's ends a list that is not full@set@
struct P_list { uint first, lights; };
uint P_index_at(P_list list, uint n) {
  uint entry = list.first + n;
  return @entry@;
}
// Reads the list up to its end: a shader that wants all lights reads up to P_end_mark or P_lights_per_cell itself.
P_list P_list_of(int cell) {
  P_list list;
  list.first = cell < 0 ? 0u : uint(cell) * P_lights_per_cell;
  list.lights = 0u;
  while (cell >= 0 && list.lights < P_lights_per_cell && P_index_at(list, list.lights) != P_end_mark) ++list.lights;
  return list;
}
)";

constexpr const char* k_runs = R"(struct P_list { uint first, runs, lights, points, spots, boxes; };
// Of each run its first light, and how many follow it.
uint P_run_number(uint entry) {
  return @entry@;
}
uint P_lights_of_runs(uint first, uint runs) {
  uint lights = 0u;
  for (uint run = first; run < first + runs; ++run) lights += P_run_number(2u * run + 1u) + 1u;
  return lights;
}
P_list P_list_of(int cell) {
  P_list list;
  list.first = list.runs = list.lights = list.points = list.spots = list.boxes = 0u;
  if (cell < 0) return list;
  uint at = uint(cell) * @words@u;
  list.first = P_headers_word(at);
@counts@  list.runs = list.points + list.spots + list.boxes;
  uint spots = list.first + list.points, boxes = spots + list.spots;
  list.points = P_lights_of_runs(list.first, list.points);
  list.spots = P_lights_of_runs(spots, list.spots);
  list.boxes = P_lights_of_runs(boxes, list.boxes);
  list.lights = list.points + list.spots + list.boxes;
  return list;
}
// Walks to the run of the nth light: a shader that wants all lights loops over the runs itself.
uint P_index_at(P_list list, uint n) {
  for (uint run = list.first; run < list.first + list.runs; ++run) {
    uint following = P_run_number(2u * run + 1u);
    if (n <= following) return P_run_number(2u * run) + n;
    n -= following + 1u;
  }
  return 0xffffffffu;
}
)";

constexpr const char* k_bitfield = R"(@constant@ P_words_per_cell = @words@u;
struct P_list { uint first, lights; };
P_list P_list_of(int cell) {
  P_list list;
  list.first = cell < 0 ? 0u : uint(cell) * P_words_per_cell;
  list.lights = 0u;
  for (uint word = 0u; cell >= 0 && word < P_words_per_cell; ++word)
    list.lights += uint(bitCount(P_words_word(list.first + word)));
  return list;
}
// Loops over bits up to the nth: a shader that wants all lights reads the words itself.
uint P_index_at(P_list list, uint n) {
  for (uint word = 0u; word < P_words_per_cell; ++word)
    for (uint left = P_words_word(list.first + word); left != 0u; left &= left - 1u)
      if (n-- == 0u) return word * 32u + uint(findLSB(left));
  return 0xffffffffu;
}
)";

constexpr const char* k_linked = R"(struct P_list { uint first, lights; };
P_list P_list_of(int cell) {
  P_list list;
  list.first = cell < 0 ? 0xffffffffu : P_heads_word(uint(cell));
  list.lights = 0u;
  for (uint node = list.first; node != 0xffffffffu; node = P_nodes_word(2u * node + 1u)) ++list.lights;
  return list;
}
// Walks to the nth node: a shader that wants all lights follows P_nodes_word(2 * node + 1) itself, to 0xffffffff.
uint P_index_at(P_list list, uint n) {
  uint node = list.first;
  for (; n > 0u && node != 0xffffffffu; --n) node = P_nodes_word(2u * node + 1u);
  return node == 0xffffffffu ? node : P_nodes_word(2u * node);
}
)";

constexpr const char* k_of_cell = R"(uint P_index_at(int cell, uint n) {
  return P_index_at(P_list_of(cell), n);
}
)";

// For views in one buffer: a sample outside of its view's grid (-1) must not become a cell of another view.
constexpr const char* k_of_view = R"(@number@ P_cells_of_view = @cells@;
P_list P_list_of(int view, int cell) {
  return P_list_of(cell < 0 ? cell : view * P_cells_of_view + cell);
}
uint P_index_at(int view, int cell, uint n) {
  return P_index_at(P_list_of(view, cell), n);
}
)";

std::string substituted(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

const SizedBuffer* buffer_named(const SizedStructure& structure, const std::string& name) {
  const auto found = std::ranges::find(structure.buffers, name, &SizedBuffer::name);
  return found == structure.buffers.end() ? nullptr : &*found;
}

// Entry number `entry` of a buffer of indices of this width.
std::string entry_code(const std::string& buffer, std::uint64_t bytes) {
  const std::string word = "P_" + buffer + "_word(entry";
  if (bytes == 1) return "(" + word + " >> 2u) >> ((entry & 3u) * 8u)) & 0xffu";
  if (bytes == 2) return "(" + word + " >> 1u) >> ((entry & 1u) * 16u)) & 0xffffu";
  return word + ")";
}

std::uint64_t cells_of_case(const result::Case& result_case) {
  const auto [x, y, z] = result_case.grid.cells;
  return x * y * z;
}

// The maximum over viewports.
std::uint64_t cells_of_view(const SizedStructure& structure) {
  std::uint64_t most = 0;
  for (const result::Case* result_case : structure.cases) most = std::max(most, cells_of_case(*result_case));
  return most;
}

// Whether all views of a frame have the same number of cells.
bool has_views_alike(const SizedStructure& structure) {
  return std::ranges::all_of(structure.cases, [&](const result::Case* one) {
    return std::ranges::all_of(structure.cases, [&](const result::Case* other) {
      return one->viewport != other->viewport || cells_of_case(*one) == cells_of_case(*other);
    });
  });
}

// Sum over all views in the buffer.
std::uint64_t cells_of(const SizedStructure& structure) {
  std::uint64_t views = 1;
  for (const std::vector<std::string>& view : structure.views) views = std::max<std::uint64_t>(views, view.size());
  return views * cells_of_view(structure);
}

// The code that decodes points, spots and boxes from a header of this size, and its words; "" for an unknown size.
struct HeaderCode {
  std::string counts;
  std::uint64_t words = 0;
};
HeaderCode header_code(const SizedBuffer& headers, bool has_boxes) {
  const std::uint64_t words = headers.element_bytes / 4, of_counts = words - 1 - (has_boxes ? 1 : 0);
  if (headers.element_bytes % 4 != 0 || of_counts < 1) return {};
  std::string counts = of_counts == 1 ? k_narrow_counts : k_wide_counts;  // beyond 2 the rest is not of lights
  if (has_boxes) counts += "  list.boxes = P_headers_word(at + " + std::to_string(of_counts == 1 ? 2 : 3) + "u);\n";
  return {counts, words};
}

// The code that reads a structure's lists, or the reason why there is none.
struct Reader {
  std::string code, refusal;
};

Reader unknown_buffers() {
  return {"", "its buffers are not those that this version knows"};
}

Reader packed_reader(const SizedStructure& structure) {
  const SizedBuffer *indices = buffer_named(structure, "indices"), *headers = buffer_named(structure, "headers");
  const HeaderCode header = headers == nullptr ? HeaderCode{} : header_code(*headers, structure.has_boxes);
  if (indices == nullptr || header.words == 0) return unknown_buffers();
  const bool is_sparse = buffer_named(structure, "header_blocks") != nullptr;
  std::string code = substituted(k_packed, "@slot@", is_sparse ? k_sparse_slot : k_dense_slot);
  code = substituted(substituted(code, "@words@", std::to_string(header.words)), "@counts@", header.counts);
  return {substituted(code, "@entry@", entry_code("indices", indices->element_bytes)), ""};
}

Reader runs_reader(const SizedStructure& structure) {
  const SizedBuffer *runs = buffer_named(structure, "runs"), *headers = buffer_named(structure, "headers");
  const HeaderCode header = headers == nullptr ? HeaderCode{} : header_code(*headers, structure.has_boxes);
  if (runs == nullptr || runs->element_bytes % 2 != 0 || header.words == 0) return unknown_buffers();
  const std::string code =
      substituted(substituted(k_runs, "@words@", std::to_string(header.words)), "@counts@", header.counts);
  return {substituted(code, "@entry@", entry_code("runs", runs->element_bytes / 2)), ""};
}

// Upper bound of the number of lights in lists: of the level and those added by a search, or those that a cull leaves.
std::uint64_t lights_of(const SizedStructure& structure) {
  double most = 0.0;
  bool is_culled = false;
  for (const result::Case* one : structure.cases) {
    const auto kept = result::number<&result::Case::pre_cull, &result::PreCull::kept, &result::MeanMax::max>(*one);
    is_culled |= kept.has_value();
    most = std::max(most, kept ? *kept : static_cast<double>(one->lights.value_or(0)));
  }
  for (const FoundFrame& found : structure.searches)
    if (!is_culled) most = std::max(most, static_cast<double>(found.lights));
  return static_cast<std::uint64_t>(most);
}

Reader fixed_reader(const SizedStructure& structure) {
  const SizedBuffer *indices = buffer_named(structure, "indices"), *counts = buffer_named(structure, "counts");
  if (indices == nullptr) return unknown_buffers();
  const std::uint64_t cells = counts == nullptr ? cells_of(structure) : counts->high_water;
  if (cells == 0) return unknown_buffers();
  const std::string room = std::to_string(std::max<std::uint64_t>(1, indices->capacity / cells)),
                    entry = entry_code("indices", indices->element_bytes);
  if (counts != nullptr) return {substituted(substituted(k_fixed, "@room@", room), "@entry@", entry), ""};
  const std::uint64_t end = lights_of(structure);
  if (end == 0) return {"", "without counts a list ends with the number of lights, and the result does not say it"};
  // Lights that a cull leaves are renumbered in each frame.
  const bool is_culled = structure.cases.front()->pre_cull.has_value();
  std::string code = substituted(substituted(k_ended, "@room@", room), "@entry@", entry);
  code = substituted(code, "@marked@", is_culled ? "@variable@" : "@constant@");
  code = substituted(code, "@set@", is_culled ? ": set it to the number of lights that the frame's cull leaves" : "");
  return {substituted(code, "@end@", std::to_string(end)), ""};
}

Reader bitfield_reader(const SizedStructure& structure) {
  const SizedBuffer* words = buffer_named(structure, "words");
  const std::uint64_t cells = cells_of(structure);
  if (words == nullptr || words->high_water == 0 || words->high_water % cells != 0) return unknown_buffers();
  return {substituted(k_bitfield, "@words@", std::to_string(words->high_water / cells)), ""};
}

Reader linked_reader(const SizedStructure& structure) {
  return buffer_named(structure, "nodes") == nullptr ? unknown_buffers() : Reader{k_linked, ""};
}

Reader reader_of(const SizedStructure& structure) {
  struct Row {
    const char* storage;
    Reader (*reader)(const SizedStructure& structure);
  };
  constexpr Row k_rows[] = {{"packed", packed_reader},
                            {"fixed", fixed_reader},
                            {"bitfield", bitfield_reader},
                            {"linked", linked_reader},
                            {"runs", runs_reader}};
  const result::Case& first = *structure.cases.front();
  if (first.react) return {"", "its tiles react, so that a cell's number is another from frame to frame"};
  if (!structure.has_grid_cells) return {"", "its cells follow visible surfaces, and are not those of the grid"};
  for (const Row& row : k_rows)
    if (first.storage.substr(0, first.storage.find('(')) == row.storage) return row.reader(structure);
  return {"", "it has no lists of cells but the method's own structure, which docs/methods.md describes"};
}

std::string declared_buffer(const std::string& name, ShaderLanguage language, int slot) {
  const std::string number = std::to_string(slot), word = name + "_word";
  std::string out = "#ifndef " + word + "  // words of 32 bits; define " + word + "(i) to read them from elsewhere\n";
  if (language == ShaderLanguage::hlsl)
    out += "StructuredBuffer<uint> " + name + "_words : register(t" + number + ");\n";
  else
    out += "layout(std430, binding = " + number + ") readonly buffer " + name + "_buffer { uint " + name +
           "_words[]; };\n";
  return out + "#define " + word + "(i) " + name + "_words[i]\n#endif\n";
}

std::string in_language(std::string code, ShaderLanguage language) {
  code = substituted(code, "@number@", language == ShaderLanguage::glsl ? "const int" : "static const int");
  if (language == ShaderLanguage::glsl)
    return substituted(substituted(code, "@constant@", "const uint"), "@variable@", "uint");
  const std::string calls = substituted(substituted(code, "bitCount(", "countbits("), "findLSB(", "firstbitlow(");
  return substituted(substituted(calls, "@constant@", "static const uint"), "@variable@", "static uint");
}

}  // namespace

std::string why_no_reader(const SizedStructure& structure) {
  return reader_of(structure).refusal;
}

std::string why_no_reader(const std::vector<result::Case>& cases) {
  result::Result result;
  result.cases = cases;
  return why_no_reader(sized_structures(result, "", {}).front());
}

std::string list_code(const NamedStructure& named, ShaderLanguage language, int& slot) {
  const Reader reader = reader_of(named.structure);
  if (reader.code.empty()) return "// no function here reads its lists: " + reader.refusal + "\n";
  std::string out = "// the nth light of a cell: NAME_index_at(cell, n); of many lights NAME_list_of(cell) once\n";
  std::string code = reader.code + k_of_cell;
  if (!named.structure.views.empty() && has_views_alike(named.structure)) {
    out += "// of the vth view in one buffer: NAME_list_of(v, cell), NAME_index_at(v, cell, n)\n";
    code += substituted(k_of_view, "@cells@", std::to_string(cells_of_view(named.structure)));
  } else if (!named.structure.views.empty()) {
    out += "// the views in one buffer have different numbers of cells: add those of the views before, and not to -1\n";
  }
  for (const std::string& buffer : named.buffers) out += declared_buffer(buffer, language, slot++);
  return out + substituted(in_language(code, language), "P_", named.name + "_");
}

std::vector<std::string> list_code_names(const NamedStructure& named) {
  std::vector<std::string> out;
  for (const char* what : {"_list", "_list_of", "_index_at", "_lights_per_cell", "_words_per_cell", "_end_mark",
                           "_run_number", "_lights_of_runs", "_cells_of_view"})
    out.push_back(named.name + what);
  for (const std::string& buffer : named.buffers)
    for (const char* what : {"_word", "_words", "_buffer"}) out.push_back(buffer + what);
  return out;
}

}  // namespace clusterbench::report
