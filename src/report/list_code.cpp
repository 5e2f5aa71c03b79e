#include "report/list_code.h"

#include <algorithm>

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

// All code is GLSL first, with P_ for the structure's name, @name@ for a number, and hlsl_of() for the other language.
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

constexpr const char* k_fixed = R"(const uint P_lights_per_cell = @room@u;
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

constexpr const char* k_bitfield = R"(const uint P_words_per_cell = @words@u;
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

std::string substituted(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

const SizedBuffer* buffer_named(const SizedStructure& structure, const std::string& name) {
  const auto found = std::ranges::find(structure.buffers, name, &SizedBuffer::name);
  return found == structure.buffers.end() ? nullptr : &*found;
}

// Entry number `entry` of indices that are so wide.
std::string entry_code(std::uint64_t bytes) {
  if (bytes == 1) return "(P_indices_word(entry >> 2u) >> ((entry & 3u) * 8u)) & 0xffu";
  if (bytes == 2) return "(P_indices_word(entry >> 1u) >> ((entry & 1u) * 16u)) & 0xffffu";
  return "P_indices_word(entry)";
}

std::uint64_t cells_of(const SizedStructure& structure) {
  std::uint64_t cells = 1;
  for (const Json& axis : (*structure.cases.front())["grid"]["cells"]) cells *= axis.get<std::uint64_t>();
  return cells;
}

std::string packed_code(const SizedStructure& structure) {
  const SizedBuffer *indices = buffer_named(structure, "indices"), *headers = buffer_named(structure, "headers");
  if (indices == nullptr || headers == nullptr || headers->element_bytes % 4 != 0) return "";
  const std::uint64_t words = headers->element_bytes / 4, of_counts = words - 1 - (structure.has_boxes ? 1 : 0);
  if (of_counts < 1 || of_counts > 2) return "";
  std::string counts = of_counts == 1 ? k_narrow_counts : k_wide_counts;
  if (structure.has_boxes) counts += "  list.boxes = P_headers_word(at + " + std::to_string(words - 1) + "u);\n";
  const bool is_sparse = buffer_named(structure, "header_blocks") != nullptr;
  std::string code = substituted(k_packed, "@slot@", is_sparse ? k_sparse_slot : k_dense_slot);
  code = substituted(substituted(code, "@words@", std::to_string(words)), "@counts@", counts);
  return substituted(code, "@entry@", entry_code(indices->element_bytes));
}

std::string fixed_code(const SizedStructure& structure) {
  const SizedBuffer *indices = buffer_named(structure, "indices"), *counts = buffer_named(structure, "counts");
  if (indices == nullptr || counts == nullptr || counts->high_water == 0) return "";
  const std::string code = substituted(
      k_fixed, "@room@", std::to_string(std::max<std::uint64_t>(1, indices->capacity / counts->high_water)));
  return substituted(code, "@entry@", entry_code(indices->element_bytes));
}

std::string bitfield_code(const SizedStructure& structure) {
  const SizedBuffer* words = buffer_named(structure, "words");
  std::size_t views = 1;
  for (const std::vector<std::string>& view : structure.views) views = std::max(views, view.size());
  const std::uint64_t cells = cells_of(structure) * views;
  if (words == nullptr || words->high_water == 0 || words->high_water % cells != 0) return "";
  return substituted(k_bitfield, "@words@", std::to_string(words->high_water / cells));
}

// "" of structures that have no lists per cell, or no code here.
std::string reading_code(const SizedStructure& structure) {
  const Json& first = *structure.cases.front();
  const auto storage = first["storage"].get<std::string>();
  // Cells that differ from frame to frame are numbered in another way.
  if (first.contains("react") || !structure.has_grid_cells) return "";
  if (storage.starts_with("packed")) return packed_code(structure);
  if (storage.starts_with("fixed")) return fixed_code(structure);
  if (storage.starts_with("bitfield")) return bitfield_code(structure);
  if (storage.starts_with("linked") && buffer_named(structure, "nodes") != nullptr) return k_linked;
  return "";
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

std::string hlsl_of(const std::string& glsl) {
  std::string code = substituted(substituted(glsl, "bitCount(", "countbits("), "findLSB(", "firstbitlow(");
  return code.starts_with("const uint") ? "static " + code : code;
}

}  // namespace

std::string list_code(const NamedStructure& named, ShaderLanguage language, int& slot) {
  const std::string code = reading_code(named.structure);
  if (code.empty()) return "";
  std::string out = "// the nth light of a cell: NAME_index_at(cell, n); of many lights NAME_list_of(cell) once\n";
  if (!named.structure.views.empty())
    out += "// of the views in one buffer the vth has its cells from v * (number of cells) on: pass that sum\n";
  for (const std::string& buffer : named.buffers) out += declared_buffer(buffer, language, slot++);
  const std::string all = code + k_of_cell;
  return out + substituted(language == ShaderLanguage::hlsl ? hlsl_of(all) : all, "P_", named.name + "_");
}

std::vector<std::string> list_code_names(const NamedStructure& named) {
  std::vector<std::string> out;
  for (const char* what : {"_list", "_list_of", "_index_at", "_lights_per_cell", "_words_per_cell"})
    out.push_back(named.name + what);
  for (const std::string& buffer : named.buffers)
    for (const char* what : {"_word", "_words", "_buffer"}) out.push_back(buffer + what);
  return out;
}

}  // namespace clusterbench::report
