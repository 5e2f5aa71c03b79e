// `clusterbench schema config|result` and `clusterbench validate FILE...`.

#include <fstream>
#include <iostream>

#include "cli/commands.h"
#include "run/config.h"
#include "run/schema_check.h"
#include "run/sweep.h"

namespace clusterbench::cli {
namespace {

std::string file_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path, "", "cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

bool is_result(const nlohmann::json& document) {
  return document.is_object() && document.contains("schema_version") && document.contains("cases");
}

ExitCode validate_result(const std::string& path, const nlohmann::json& document) {
  const std::vector<std::string> violations = run::schema_violations(run::result_schema(), document);
  for (const std::string& violation : violations) std::cerr << path << ": " << violation << "\n";
  if (violations.empty()) std::cout << path << ": a valid result with " << document["cases"].size() << " cases\n";
  return violations.empty() ? ExitCode::ok : ExitCode::usage;
}

ExitCode validate_config(const std::string& path) {
  const run::Config config = run::load_config(path);
  const run::Plan plan = run::make_plan(config, "");
  std::size_t cases = 0;
  for (const run::GroupPlan& group : plan.groups) cases += group.cases.size();
  std::cout << path << ": a valid configuration with " << plan.scenes.size() << " scenes, " << cases << " cases, "
            << plan.skipped.size() << " skipped\n";
  return ExitCode::ok;
}

ExitCode validate(const std::string& path) {
  const nlohmann::json document = nlohmann::json::parse(file_text(path), nullptr, false, true);
  return is_result(document) ? validate_result(path, document) : validate_config(path);
}

}  // namespace

void add_schema(Command& program, Action& action) {
  Command command = program.add_command("schema", "Print the JSON Schema (draft-07) of a configuration or of a result");
  auto which = std::make_shared<std::string>();
  command.add_option("WHICH", *which, "config or result").required().one_of({"config", "result"});
  command.when_named([which, &action] {
    action = [which] {
      std::cout << (*which == "config" ? run::config_schema() : run::result_schema()).dump(2) << "\n";
      return ExitCode::ok;
    };
  });
}

void add_validate(Command& program, Action& action) {
  Command command = program.add_command("validate", "Check configurations and results without running anything");
  auto paths = std::make_shared<std::vector<std::string>>();
  command.add_option("FILE", *paths, "Configuration or result files").required();
  command.when_named([paths, &action] {
    action = [paths] {
      ExitCode worst = ExitCode::ok;
      for (const std::string& path : *paths)
        if (validate(path) != ExitCode::ok) worst = ExitCode::usage;
      return worst;
    };
  });
}

}  // namespace clusterbench::cli
