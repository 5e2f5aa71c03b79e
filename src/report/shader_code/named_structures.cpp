#include "report/shader_code/named_structures.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/error.h"
#include "report/shader_code/list_code.h"
#include "report/shader_code/lookup_code.h"
#include "report/shader_code/lookup_constants.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t k_longest = 200;  // GLSL allows 1024, with suffixes

// Letters, digits, and single underscores for all other characters.
std::string identifier(const std::string& name) {
  std::string id;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte) != 0)
      id += c;
    else if (!id.empty() && id.back() != '_')
      id += '_';
  }
  id.resize(std::min(id.size(), k_longest));
  while (!id.empty() && id.back() == '_') id.pop_back();
  if (id.empty()) return "case";
  const bool is_reserved = id.starts_with("gl_");  // by GLSL
  return is_reserved || std::isdigit(static_cast<unsigned char>(id.front())) != 0 ? "case_" + id : id;
}

// Identifies a lookup. A function with a viewport parameter is equal for all viewports, and values that a program sets
// in each frame do not count.
Json lookup_key(const result::Case& result_case, LookupsOf lookups) {
  std::vector<LookupConstant> constants = lookup_constants(result_case);
  const std::string name = "lookup";
  if (lookups == LookupsOf::all_viewports &&
      lookup_function_glsl(name, result_case).find(name + "_tiles_of(") != std::string::npos) {
    std::erase_if(constants, [](const LookupConstant& constant) {
      return constant.name == "viewport" || constant.name == "tile_scale" || constant.name == "cells" ||
             constant.changes;
    });
    constants.push_back(
        {"slices", LookupConstant::Type::integer, {static_cast<double>(result_case.grid.cells.back())}});
  }
  return {lookup_note(result_case), lookup_json(constants)};
}

// Cases of cameras with the same lookup, the first camera's first.
std::vector<NamedLookup> lookups_of(const SizedStructure& structure, LookupsOf lookups) {
  std::vector<NamedLookup> out;
  std::vector<Json> known;
  for (const result::Case* result_case : structure.cases) {
    if (result_case->storage == "own") continue;
    const Json key = lookup_key(*result_case, lookups);
    const auto at = static_cast<std::size_t>(std::ranges::find(known, key) - known.begin());
    if (at == known.size()) {
      known.push_back(key);
      out.emplace_back();
    }
    out[at].cases.push_back(result_case);
  }
  return out;
}

void give_name(NamedStructure& named, const std::string& name) {
  named.name = name;
  named.buffers.clear();
  for (const SizedBuffer& buffer : named.structure.buffers)
    named.buffers.push_back(name + "_" + identifier(buffer.name));
  std::set<std::string> cameras;
  for (NamedLookup& lookup : named.lookups) {
    if (named.lookups.size() == 1) {
      lookup.name = name + "_lookup";
      continue;
    }
    const std::string camera = identifier(lookup.cases.front()->camera);
    std::string unique = camera;
    for (int number = 2; !cameras.insert(unique).second; ++number) unique = camera + "_" + std::to_string(number);
    lookup.name = name + "_" + unique + "_lookup";
  }
}

// All names declared for it in any language.
std::vector<std::string> declared_names(const NamedStructure& named) {
  std::vector<std::string> out;
  for (const std::string& buffer : named.buffers)
    for (const char* what : {"", "_capacity", "_warn_above", "_bytes", "_element_bytes"}) out.push_back(buffer + what);
  for (const NamedLookup& lookup : named.lookups) {
    out.push_back(lookup.name);
    out.push_back(lookup.name + "_cell_of");
    out.push_back(lookup.name + "_tiles_of");
    for (const LookupConstant& constant : lookup_constants(*lookup.cases.front()))
      out.push_back(lookup.name + "_" + constant.name);
  }
  const std::vector<std::string> of_lists = list_code_names(named);
  out.insert(out.end(), of_lists.begin(), of_lists.end());
  return out;
}

NamedStructure under_name(SizedStructure structure, const std::string& name, LookupsOf lookups) {
  NamedStructure named;
  named.structure = std::move(structure);
  named.lookups = lookups_of(named.structure, lookups);
  give_name(named, name);
  return named;
}

}  // namespace

std::vector<NamedStructure> named_structures(std::vector<SizedStructure> structures, const std::string& name,
                                             LookupsOf lookups) {
  if (identifier(name) != name)
    throw Error(
        "", "--name",
        "'" + name + "' is no name in C++, HLSL and GLSL alike; takes letters, digits and single underscores, " +
            "a letter first, such as " + identifier(name) + "; at most " + std::to_string(k_longest) + " of them");
  std::string which;  // the first two
  for (std::size_t i = 0; i < std::min<std::size_t>(structures.size(), 2); ++i) which += ", " + structures[i].name;
  if (structures.size() > 2) which += " ...";
  if (structures.size() != 1)
    throw Error("", "--name",
                "names one structure, and these are " + std::to_string(structures.size()) + which +
                    "; choose one of them with --filter");
  return {under_name(std::move(structures.front()), name, lookups)};
}

std::vector<NamedStructure> named_structures(std::vector<SizedStructure> structures, bool in_full, LookupsOf lookups) {
  std::vector<NamedStructure> out;
  std::set<std::string> taken;
  for (SizedStructure& structure : structures) {
    const std::string id = identifier(in_full ? structure.name : structure.group);
    NamedStructure named = under_name(std::move(structure), id, lookups);
    const auto is_taken = [&](const std::string& name) { return taken.contains(name); };
    for (int number = 2; std::ranges::any_of(declared_names(named), is_taken); ++number)
      give_name(named, id + "_" + std::to_string(number));
    for (const std::string& name : declared_names(named)) taken.insert(name);
    out.push_back(std::move(named));
  }
  return out;
}

}  // namespace clusterbench::report
