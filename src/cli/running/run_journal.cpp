#include "cli/running/run_journal.h"

#include <filesystem>

#include "cli/output/output.h"
#include "config/config_plugins.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/sha256.h"
#include "core/text.h"
#include "os/host_name.h"
#include "os/stop_signals.h"
#include "run/records/records.h"
#include "run/runner.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

// The configuration without the keys that do not change results.
Json measured_config(const config::Config& config) {
  Json out = config.resolved;
  for (const char* key : {"threads", "device"})
    out.erase(key);  // the header has the device itself, however it is named
  for (const char* gate : {"fail_if", "baseline", "allow_no_lights", "allow_changed_lights"}) out["limits"].erase(gate);
  return out;
}

}  // namespace

Json run_identity(const RunFlags& flags, const config::Config& config, const run::Plan& plan) {
  const run::ToolFacts tool = run::tool_facts();
  Json scenes = Json::array();
  for (const run::SceneData& data : plan.scenes) scenes.push_back(data.contents_sha256());
  Json header{{"version", tool.version}, {"git_sha", tool.git_sha}, {"flags", tool.flags},
              {"scenes", scenes},        {"filter", flags.filter},  {"config", measured_config(config)}};
  for (const plugin::LoadedPlugin* loaded : config::plugins_of(config))
    header["plugins"][loaded->facts.id] = loaded->sha256;
  if (!flags.count.empty()) header["count"] = flags.count;
  for (const config::MethodRequest& method : config.assigners)
    if (const auto& origin = assign::find_assigner(method.name)->origin)
      header["methods"][method.name] = origin->sha256;
  return header;
}

namespace {

bool depends_on_machine(const RunFlags& flags, const config::Config& config) {
  return config.timing.measure || !flags.count.empty();
}

}  // namespace

std::string host_digest(const RunFlags& flags, const config::Config& config) {
  if (!depends_on_machine(flags, config)) return "";
  constexpr std::size_t k_digits = 12;
  const std::string name = os::host_name();
  return name.empty() ? "" : sha256_hex(name).substr(0, k_digits);
}

namespace {

// The facts that must be the same in an interrupted run and the run that continues it.
Json journal_header(const RunFlags& flags, const config::Config& config, const run::Plan& plan) {
  Json header = run_identity(flags, config, plan);
  if (plan.shard) header["shard"] = {plan.shard->index, plan.shard->count};
  if (depends_on_machine(flags, config))
    header["machine"] = {{"cpu", run::machine_facts().cpu}, {"host", host_digest(flags, config)}};
  if (const std::optional<gpu::DeviceFacts> device = run::device_of(config, plan))
    header["device"] = {{"name", device->name}, {"driver", device->driver}, {"uuid", device->uuid}};
  return header;
}

// A complete result of another build of a plug-in is a baseline that --resume would replace.
void refuse_other_builds(const std::string& file, const config::Config& config) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return;
  const Json result = json_or_discarded<Json>(file_text(file));
  if (!result.is_object() || !result.contains("plugins") || !result["plugins"].is_array()) return;
  for (const Json& one : result["plugins"])
    for (const plugin::LoadedPlugin* loaded : config::plugins_of(config)) {
      const bool is_other = one.is_object() && one.value("id", Json()) == loaded->facts.id &&
                            one.value("sha256", Json()) != loaded->sha256;
      if (is_other)
        throw Error(file, "--resume",
                    "is a complete result, with another build of the plug-in " + loaded->facts.id + " (sha256 " +
                        printable(one.value("sha256", Json()).dump()) + ", now \"" + loaded->sha256 +
                        "\"); name another file, or leave out --resume, and it is replaced");
    }
}

// Whether the output is a file. Throws Error if --resume needs one.
bool has_journal(const RunFlags& flags) {
  if (!is_stream(flags.output)) return true;
  if (flags.resume) throw Error("", "--resume", "needs the result file of the interrupted run: add -o FILE");
  return false;
}

// At most, of a case in the result, and in the journal: about 3 KiB, and 5 KiB more with times.
std::uint64_t bytes_per_case(const config::Config& config) {
  constexpr std::uint64_t k_counted = 4 << 10, k_timed = 12 << 10;
  return config.timing.measure ? k_timed : k_counted;
}

}  // namespace

std::vector<std::string> finished_ids(const RunFlags& flags, const config::Config& config, const run::Plan& plan) {
  if (!has_journal(flags) || !flags.resume) return {};
  return report::finished_ids(flags.output, journal_header(flags, config, plan));
}

RunJournal::RunJournal(const RunFlags& flags, const config::Config& config, const run::Plan& plan)
    : is_kept_(has_journal(flags)) {
  const std::string file = is_kept_ ? flags.output : flags.part.result_file;
  if (file.empty()) return;
  const bool goes_on = flags.part.number > 0;
  // Details have a limit for each case, which few come near: room for one of them.
  const std::uint64_t bytes =
      bytes_per_case(config) * plan.case_count() + (config.details ? config.details->max_bytes : 0);
  journal_ =
      std::make_unique<report::Journal>(file, journal_header(flags, config, plan), flags.resume || goes_on, bytes);
  if (goes_on) return;
  if (flags.resume && journal_->is_empty()) refuse_other_builds(file, config);
  if (journal_->is_set_aside_of_other_machine()) {
    print_message(journal_->partial_path().string() +
                  " has times of another machine, which are never mixed with this one's: " +
                  (journal_->set_aside().empty()
                       ? "none is finished, and --resume begins anew"
                       : "--resume begins anew, and the file is now " + journal_->set_aside().string()));
    return;
  }
  if (flags.resume && journal_->is_empty())
    print_message("note: no interrupted run has left finished cases in " + journal_->partial_path().string() +
                  ", so --resume begins anew");
  if (!journal_->set_aside().empty())
    print_message(journal_->partial_path().string() +
                  (journal_->is_set_aside_of_run() ? ", left by a run that did not end," : ", which is of no run,") +
                  " is now " + journal_->set_aside().string() +
                  (journal_->is_set_aside_of_run() ? " (--resume goes on with such a file)" : ""));
}

std::vector<result::Case> RunJournal::earlier_cases() const {
  return journal_ ? journal_->earlier_cases() : std::vector<result::Case>{};
}

std::vector<std::string> RunJournal::earlier_ids() const {
  return journal_ ? journal_->earlier_ids() : std::vector<std::string>{};
}

std::vector<result::BrokenCase> RunJournal::earlier_broken() const {
  return journal_ ? journal_->earlier_broken() : std::vector<result::BrokenCase>{};
}

std::string RunJournal::saved_cases_text() const {
  if (!is_kept_ || journal_->is_empty()) return "";
  return "; what was measured is in " + journal_->partial_path().string() + ", --resume goes on";
}

Error RunJournal::with_saved_cases(const Error& error) const {
  const std::string saved = saved_cases_text();
  return Error(error.file(), error.where(),
               error.message() + saved + (saved.empty() ? "" : " with the same scenes, configuration and program"),
               error.code());
}

ExitCode RunJournal::interrupted() const {
  if (!is_kept_)
    print_message(
        "interrupted; nothing is kept without a file: -o FILE keeps each case as it is finished, and then --resume "
        "goes on");
  else if (journal_->is_empty())
    print_message(
        "interrupted before a case was finished, so nothing is kept: the same command begins anew; once some are, "
        "--resume goes on");
  else
    print_message("interrupted" + saved_cases_text());
  return os::stopped_exit_code();
}

}  // namespace clusterbench::cli
