#include "cli/options/shard_choice.h"

#include <charconv>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "run/shards.h"

namespace clusterbench::cli {
namespace {

constexpr const char* k_flag = "--shard";

// The largest number for a larger one, which is refused as such.
std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || end != text.data() + text.size()) return std::nullopt;
  if (failed == std::errc::result_out_of_range) return std::numeric_limits<std::uint64_t>::max();
  if (failed != std::errc()) return std::nullopt;
  return number;
}

[[noreturn]] void refuse(const std::string& what) {
  throw Error("", k_flag, what);
}

void check_count(const std::string& text, std::uint64_t count) {
  if (count == 0) refuse("'" + text + "' divides the run into 0 shards; N is at least 1");
  if (count > run::k_most_shards)
    refuse("'" + text + "' has more shards than a run can have cases; N is at most " +
           std::to_string(run::k_most_shards));
}

void check_range(const std::string& text, const ShardChoice& choice) {
  check_count(text, choice.count);
  if (choice.index >= 1 && choice.index <= choice.count) return;
  const std::string count = std::to_string(choice.count);
  refuse("'" + text + "' is none of the shards, which are counted from 1: 1/" + count + " to " + count + "/" + count);
}

// A service's numbering of the jobs of an array, as its variables tell it.
struct ArrayJob {
  std::string service, index_name, count_name;  // for messages
  std::uint64_t index = 1;                      // from 1
  std::optional<std::uint64_t> count = {};
  std::uint64_t first = 1;  // of the variable

  std::string untold_count() const {
    return service == "Kubernetes" ? "with the Job's completions"
                                   : "with the array's size: " + count_name + " is not set";
  }
};

class Environment {
 public:
  explicit Environment(const Variable& variable) : variable_(variable) {}

  bool has(const char* name) const { return variable_(name) != nullptr; }

  std::uint64_t number(const char* name) const {
    const char* text = variable_(name);
    if (text == nullptr) refuse(std::string("auto: ") + name + " is not set, though others of its service are");
    const std::optional<std::uint64_t> number = whole_number(text);
    if (!number) refuse(std::string("auto: ") + name + " is '" + printable(text) + "', which is no number");
    return *number;
  }

  bool is_number(const char* name) const {
    const char* text = variable_(name);
    return text != nullptr && whole_number(text);
  }

 private:
  const Variable& variable_;
};

// https://docs.gitlab.com/ci/variables/predefined_variables: CI_NODE_TOTAL is 1, without an index, where a job has no
// `parallel`.
std::optional<ArrayJob> gitlab_job(const Environment& environment) {
  if (!environment.has("CI_NODE_INDEX") && !environment.has("CI_NODE_TOTAL")) return std::nullopt;
  const std::uint64_t count = environment.number("CI_NODE_TOTAL");
  const bool is_alone = count == 1 && !environment.has("CI_NODE_INDEX");
  return ArrayJob{"GitLab", "CI_NODE_INDEX", "CI_NODE_TOTAL", is_alone ? 1 : environment.number("CI_NODE_INDEX"),
                  count};
}

// The numbers FIRST, FIRST + STEP ... LAST. Throws Error for an index that is none of them.
struct ArrayRange {
  const char* index_name;
  std::uint64_t index, first, last, step;

  std::uint64_t count() const { return (last - first) / step + 1; }
  std::uint64_t position() const {
    if (step == 0 || last < first || index < first || index > last || (index - first) % step != 0)
      refuse(std::string("auto: ") + index_name + " is " + std::to_string(index) + ", which is none of " +
             std::to_string(first) + " to " + std::to_string(last) + " in steps of " + std::to_string(step));
    return (index - first) / step + 1;
  }
};

// sbatch(1), "output environment variables".
std::optional<ArrayJob> slurm_job(const Environment& environment) {
  if (!environment.has("SLURM_ARRAY_TASK_ID")) return std::nullopt;
  const ArrayRange range{"SLURM_ARRAY_TASK_ID", environment.number("SLURM_ARRAY_TASK_ID"),
                         environment.number("SLURM_ARRAY_TASK_MIN"), environment.number("SLURM_ARRAY_TASK_MAX"),
                         environment.has("SLURM_ARRAY_TASK_STEP") ? environment.number("SLURM_ARRAY_TASK_STEP") : 1};
  const std::uint64_t count = environment.number("SLURM_ARRAY_TASK_COUNT"), index = range.position();
  if (count != range.count())
    refuse("auto: SLURM_ARRAY_TASK_COUNT is " + std::to_string(count) + ", and the tasks " +
           std::to_string(range.first) + " to " + std::to_string(range.last) + " are " + std::to_string(range.count()) +
           ": an array with gaps does not say which shard is which; submit --array=1-N, and to repeat a single shard " +
           "take --shard I/N");
  return ArrayJob{"Slurm", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", index, count};
}

// qsub(1) of Grid Engine; SGE_TASK_ID is "undefined" outside of an array job.
std::optional<ArrayJob> grid_engine_job(const Environment& environment) {
  if (!environment.is_number("SGE_TASK_ID")) return std::nullopt;
  const ArrayRange range{"SGE_TASK_ID", environment.number("SGE_TASK_ID"), environment.number("SGE_TASK_FIRST"),
                         environment.number("SGE_TASK_LAST"), environment.number("SGE_TASK_STEPSIZE")};
  const std::uint64_t index = range.position();
  return ArrayJob{"Grid Engine", "SGE_TASK_ID", "SGE_TASK_LAST", index, range.count()};
}

// An indexed Job of Kubernetes; its completions are in no variable.
std::optional<ArrayJob> kubernetes_job(const Environment& environment) {
  if (!environment.has("JOB_COMPLETION_INDEX")) return std::nullopt;
  return ArrayJob{"Kubernetes", "JOB_COMPLETION_INDEX", "", environment.number("JOB_COMPLETION_INDEX") + 1, {}, 0};
}

// https://docs.aws.amazon.com/batch/latest/userguide/job_env_vars.html
std::optional<ArrayJob> aws_job(const Environment& environment) {
  if (!environment.has("AWS_BATCH_JOB_ARRAY_INDEX")) return std::nullopt;
  ArrayJob job{"AWS Batch",
               "AWS_BATCH_JOB_ARRAY_INDEX",
               "AWS_BATCH_JOB_ARRAY_SIZE",
               environment.number("AWS_BATCH_JOB_ARRAY_INDEX") + 1,
               {},
               0};
  if (environment.has("AWS_BATCH_JOB_ARRAY_SIZE")) job.count = environment.number("AWS_BATCH_JOB_ARRAY_SIZE");
  return job;
}

std::vector<ArrayJob> array_jobs(const Environment& environment) {
  std::vector<ArrayJob> jobs;
  for (const auto find : {gitlab_job, slurm_job, grid_engine_job, kubernetes_job, aws_job})
    if (const std::optional<ArrayJob> job = find(environment)) jobs.push_back(*job);
  return jobs;
}

std::string text_of(const ArrayJob& job) {
  return job.service + " (" + job.index_name + ") says shard " + std::to_string(job.index) +
         (job.count ? " of " + std::to_string(*job.count) : "");
}

void check_agreement(const ArrayJob& one, const ArrayJob& other) {
  const bool has_other_count = one.count && other.count && *one.count != *other.count;
  if (one.index == other.index && !has_other_count) return;
  refuse("auto: " + text_of(one) + ", and " + text_of(other) + "; write --shard I/N");
}

// Names the variable that says what no shard can be.
void check_job(const std::string& text, const ArrayJob& job, std::uint64_t count) {
  if (job.count && (*job.count == 0 || *job.count > run::k_most_shards))
    refuse("auto: " + job.count_name + " makes " + std::to_string(*job.count) + " shards; it is 1 to " +
           std::to_string(run::k_most_shards));
  if (job.index >= 1 && job.index <= count) return;
  refuse(printable(text) + ": " + job.index_name + " is " + std::to_string(job.index - 1 + job.first) +
         ", which is none of " + std::to_string(job.first) + " to " + std::to_string(count - 1 + job.first) + " of " +
         std::to_string(count) + " shards (" + job.service + ")");
}

ShardChoice automatic(const std::string& text, std::optional<std::uint64_t> count, const Environment& environment) {
  const std::vector<ArrayJob> jobs = array_jobs(environment);
  if (jobs.empty())
    refuse("auto: no array job is known here: CI_NODE_INDEX, SLURM_ARRAY_TASK_ID, SGE_TASK_ID, JOB_COMPLETION_INDEX " +
           std::string("and AWS_BATCH_JOB_ARRAY_INDEX are not set; write --shard I/N"));
  for (const ArrayJob& job : jobs) {
    check_agreement(jobs.front(), job);
    if (count && job.count && *count != *job.count)
      refuse("'" + text + "' has " + std::to_string(*count) + " shards, and " + text_of(job) + "; write --shard I/N");
    if (job.count && !count) count = job.count;
  }
  if (!count)
    refuse("auto: " + text_of(jobs.front()) + ", but not of how many; write --shard auto/N " +
           jobs.front().untold_count());
  for (const ArrayJob& job : jobs) check_job(text, job, *count);
  return {jobs.front().index, *count};
}

}  // namespace

ShardChoice shard_choice(const std::string& text, const Variable& variable) {
  const std::size_t slash = text.find('/');
  const std::string first = text.substr(0, slash);
  std::optional<std::uint64_t> count;
  if (slash != std::string::npos) count = whole_number(std::string_view(text).substr(slash + 1));
  const std::optional<std::uint64_t> index = whole_number(first);
  const bool has_form = slash == std::string::npos ? first == "auto" : count && (index || first == "auto");
  if (!has_form) refuse("'" + printable(text) + "' is no shard; it is I/N, as 2/7, or auto, or auto/N");
  if (count) check_count(text, *count);
  const ShardChoice choice = index ? ShardChoice{*index, *count} : automatic(text, count, Environment(variable));
  check_range(text, choice);
  return choice;
}

ShardChoice shard_choice(const std::string& text) {
  return shard_choice(text, [](const char* name) -> const char* { return std::getenv(name); });
}

}  // namespace clusterbench::cli
