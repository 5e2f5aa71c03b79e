#include "library/engine_words.h"

#include <cmath>
#include <cstdio>
#include <map>

namespace clusterbench::library {
namespace {

// Errors of grids and methods name keys of a configuration. "": none of these.
std::string argument_of(const std::string& key) {
  static const std::map<std::string, const char*> k_arguments{
      {"tiles.pixels", "grid.tile_width, grid.tile_height"},
      {"tiles.count", "grid.columns, grid.rows"},
      {"tiles", "grid.tile_width, grid.tile_height, grid.columns, grid.rows"},
      {"slices", "grid.slices"},
      {"slices.scheme", "grid.slicing"},
      {"slices.near", "grid.near_m"},
      {"slices.far", "grid.far_m"},
      {"slices.first", "grid.first_m"},
      {"slices.lambda", "grid.lambda"},
      {"slices.count", "grid.slices"},
      {"slices.boundaries", "grid.boundaries_m"},
      {"bounds", "grid.lo_m, grid.hi_m"},
      {"finest", "grid.finest_m"},
      {"cells", "grid.cells"},
      {"camera", "view"},
      {"limits.memory_mib", "set_memory_limit"}};
  const auto found = k_arguments.find(key);
  return found == k_arguments.end() ? "" : found->second;
}

void replace_words(const std::string& words, const std::string& by, std::string& text) {
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + by.size()))
    text.replace(at, words.size(), by);
}

}  // namespace

std::string short_number(double value) {
  if (std::isnan(value)) return "nan";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void refuse(const std::string& where, const std::string& problem) {
  throw Error("", where, problem);
}

std::string grid_argument_of(const std::string& key) {
  const std::string argument = argument_of(key);
  return argument.empty() ? "grid." + key : argument;
}

std::string text_for_engines(const Error& error) {
  if (!error.file().empty()) return error.what();
  std::string message = error.message();
  replace_words("grids.*.slices.first", "grid.first_m", message);
  replace_words("grids.*.slices.scheme", "grid.slicing", message);
  const std::string argument = argument_of(error.where()), where = argument.empty() ? error.where() : argument;
  return where.empty() ? message : where + ": " + message;
}

}  // namespace clusterbench::library
