// `clusterbench size RESULT`: what to allocate, and the code that watches it.

#include <fstream>
#include <iostream>

#include "cli/command.h"
#include "report/size.h"

namespace clusterbench::cli {
namespace {

nlohmann::ordered_json read_result(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path, "", "cannot be read");
  nlohmann::ordered_json result;
  try {
    result = nlohmann::ordered_json::parse(in);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(path, "byte " + std::to_string(error.byte), "is not JSON");
  }
  if (!result.is_object() || !result.contains("schema_version") || !result.contains("cases"))
    throw Error(path, "", "is not a result file of `clusterbench run`");
  if (result["schema_version"] != 1)
    throw Error(path, "/schema_version", "is " + result["schema_version"].dump() + "; this version reads 1");
  return result;
}

}  // namespace

void add_size(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "size", "Size the light-list allocation from a result: high-water marks, margins, C++ constants");
  auto file = std::make_shared<std::string>();
  command->add_option("RESULT", *file, "A result file of `clusterbench run`")->required();
  command->callback([file, &action] {
    action = [file] {
      std::cout << report::size_report(read_result(*file));
      return ExitCode::ok;
    };
  });
}

}  // namespace clusterbench::cli
