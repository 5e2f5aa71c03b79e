// `clusterbench schema
// `clusterbench schema
// config|result|comparison|ratios|recommendation|stress|worst-case|size|light-map|dump|check|plugin-check|shader` and
// `clusterbench validate FILE...`.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "cli/command_line/commands.h"
#include "cli/options/guarded_command.h"
#include "cli/options/plugin_option.h"
#include "cli/output/output.h"
#include "config/config.h"
#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "dump/dump_file.h"
#include "gpu/user_shaders/shader_method.h"
#include "gpu/user_shaders/shader_obstacles.h"
#include "report/documents/result_file.h"
#include "report/history/history.h"
#include "result/result.h"
#include "run/cases/plan.h"

namespace clusterbench::cli {
namespace {

ExitCode validate_written(const std::string& path, const nlohmann::json& document, const config::DocumentRow& row) {
  config::check_version(path, document, row);
  const std::vector<std::string> violations = config::schema_violations(row.schema(), document);
  for (const std::string& violation : violations) print_message(path + ": " + violation);
  if (!violations.empty()) return ExitCode::usage;
  if (row.document == config::Document::result) report::read_result(path);              // cases that are there twice
  if (row.document == config::Document::dump) dump::parse_dump(file_text(path), path);  // keys that nothing reads
  for (const char* part : {"case", "block", "answer", "frame", "structure", "scene", "list", "test"}) {
    const std::string parts = std::string(part) + "s";
    if (!document.contains(parts)) continue;
    std::cout << path << ": valid, " << row.title << " with " << number_of(document[parts].size(), part) << "\n";
    break;
  }
  return ExitCode::ok;
}

ExitCode validate_config(const std::string& path) {
  const config::Config config = config::load_config(path);
  const run::Plan plan = run::make_plan(config, "");
  std::cout << path << ": a valid configuration with " << number_of(plan.scenes.size(), "scene") << ", "
            << number_of(plan.case_count(), "case") << ", " << plan.skipped.size() << " skipped\n";
  return ExitCode::ok;
}

// With its modules, and held against the device that is there.
ExitCode validate_shader(const std::string& path) {
  const gpu::ShaderFile file = gpu::read_shader_file(path);
  gpu::check_shader_name(file);
  const std::string obstacle = gpu::shader_obstacle(file);
  std::cout << path << ": valid, method '" << file.record.name << "' with " << std::to_string(file.record.passes.size())
            << (file.record.passes.size() == 1 ? " pass, " : " passes, ")
            << number_of(file.record.buffers.size(), "buffer")
            << (obstacle.empty() ? "" : "; it cannot run here: " + printable(obstacle)) << "\n";
  return ExitCode::ok;
}

ExitCode validate_history(const std::string& path) {
  std::cout << path << ": valid, a history with " << number_of(report::read_history(path).size(), "result") << "\n";
  return ExitCode::ok;
}

ExitCode validate(const std::string& path) {
  const std::string text = file_text(path);
  if (report::is_history(text)) return validate_history(path);
  const nlohmann::json document = json_or_discarded<nlohmann::json>(text, JsonComments::allowed);
  const config::DocumentRow& row = config::row_of(config::document_of(document));
  if (row.document == config::Document::shader) return validate_shader(path);
  return row.document == config::Document::config ? validate_config(path) : validate_written(path, document, row);
}

void print_schema(const std::string& name) {
  const auto rows = config::document_rows();
  const config::DocumentRow& row = *std::ranges::find(rows, name, &config::DocumentRow::name);
  const bool is_result = row.document == config::Document::result;  // in the order of its fields
  std::cout << (is_result ? result::result_schema().dump(2) : row.schema().dump(2)) << "\n";
}

// A configuration that names plug-ins loads them, and looks for methods in the folders of the path variable.
ExitCode validate_apart(const std::string& path) {
  RunInputs inputs;
  inputs.paths = {path};
  std::error_code none;
  const bool can_name = names_plugins(inputs) || !std::filesystem::is_regular_file(path, none);  // or a pipe
  if (!can_name) return validate(path);
  try {
    return run_apart([&] { return validate(path); });
  } catch (const Error& error) {  // a plug-in broke down
    throw Error(path, error.where(), error.message(), error.code());
  }
}

}  // namespace

void add_schema(Command& program, Action& action) {
  Command command = program.add_command("schema", "Print the JSON Schema (draft-07) of a document");
  std::vector<std::string> names;
  for (const config::DocumentRow& row : config::document_rows()) names.emplace_back(row.name);
  auto name = std::make_shared<std::string>();
  command
      .add_option(
          "WHICH", *name,
          "Of a configuration, or of what run, compare --json, ratio --json, recommend, stress, worst-case, "
          "size --format json, light-map, check --json or plugin check --json write, or of a dump that check reads, or "
          "of a method of --shader")
      .required()
      .one_of(names);
  auto plugins = std::make_shared<std::vector<std::string>>();
  add_plugin_option(command, *plugins);
  command.when_named([name, plugins, &action] {
    action = [name, plugins] {
      const auto print = [&] {
        load_plugins(*plugins);
        print_schema(*name);
        return ExitCode::ok;
      };
      return plugins->empty() ? print() : run_guarded_once(loading_limits(), ExitCode::usage, print);
    };
  });
}

void add_validate(Command& program, Action& action) {
  Command command = program.add_command(
      "validate", "Check configurations, methods of --shader and what clusterbench wrote, without running anything");
  auto paths = std::make_shared<std::vector<std::string>>();
  command
      .add_option("FILE", *paths,
                  "Configurations, methods of --shader, results, histories, comparisons, ratios, recommendations, "
                  "results of stress, worst-case and light-map, checks of plug-ins")
      .required();
  command.when_named([paths, &action] {
    action = [paths] {
      ExitCode worst = ExitCode::ok;
      for (const std::string& path : *paths) {
        try {
          if (const ExitCode code = validate_apart(path); code != ExitCode::ok) worst = code;
        } catch (const Error& error) {  // the other files are still checked
          print_message(error.what());
          worst = error.code();
        }
      }
      return worst;
    };
  });
}

}  // namespace clusterbench::cli
