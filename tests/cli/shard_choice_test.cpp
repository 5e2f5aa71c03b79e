// `--shard`: what users and services of array jobs may say.

#include "cli/options/shard_choice.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"

namespace clusterbench::cli {
namespace {

using Variables = std::map<std::string, std::string>;

std::string choice(const std::string& text, const Variables& variables = {}) {
  try {
    const ShardChoice chosen = shard_choice(text, [&](const char* name) {
      const auto found = variables.find(name);
      return found == variables.end() ? nullptr : found->second.c_str();
    });
    return std::to_string(chosen.index) + "/" + std::to_string(chosen.count);
  } catch (const Error& error) {
    return error.what();
  }
}

void expect_refused(const std::string& said, const std::string& part) {
  EXPECT_EQ(said.find("--shard: "), 0u) << said;
  EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(ShardChoice, is_a_number_from_1_to_N) {
  EXPECT_EQ(choice("1/1"), "1/1");
  EXPECT_EQ(choice("7/7"), "7/7");
  EXPECT_EQ(choice("100000/100000"), "100000/100000");
}

TEST(ShardChoice, outside_of_the_range_is_refused_with_it) {
  expect_refused(choice("0/3"), "'0/3' is none of the shards, which are counted from 1: 1/3 to 3/3");
  expect_refused(choice("4/3"), "1/3 to 3/3");
  expect_refused(choice("1/0"), "divides the run into 0 shards; N is at least 1");
  expect_refused(choice("1/100001"), "N is at most 100000");
  expect_refused(choice("1/99999999999999999999999"), "N is at most 100000");
  expect_refused(choice("auto/0"), "N is at least 1");
}

TEST(ShardChoice, of_another_form_is_refused_with_the_right_one) {
  for (const char* text : {"", "2", "/", "1/", "/2", "a/b", "1/2/3", "-1/2", "+1/2", "1 /2", "1/2 ", "0x1/2", "1.0/2",
                           "automatic", "auto/", "auto/x", "AUTO"})
    expect_refused(choice(text), "is no shard; it is I/N, as 2/7, or auto, or auto/N");
}

TEST(ShardChoice, takes_what_an_array_job_says) {
  EXPECT_EQ(choice("auto", {{"CI_NODE_INDEX", "3"}, {"CI_NODE_TOTAL", "5"}}), "3/5");
  EXPECT_EQ(choice("auto", {{"CI_NODE_TOTAL", "1"}}), "1/1");  // GitLab without `parallel`
  EXPECT_EQ(choice("auto", {{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "10"}}), "1/10");
  EXPECT_EQ(choice("auto/4", {{"JOB_COMPLETION_INDEX", "3"}}), "4/4");
}

Variables slurm(const std::string& id, const std::string& min, const std::string& max, const std::string& count,
                const std::string& step = "1") {
  return {{"SLURM_ARRAY_TASK_ID", id},
          {"SLURM_ARRAY_TASK_MIN", min},
          {"SLURM_ARRAY_TASK_MAX", max},
          {"SLURM_ARRAY_TASK_COUNT", count},
          {"SLURM_ARRAY_TASK_STEP", step}};
}

TEST(ShardChoice, numbers_the_tasks_of_an_array_from_1_wherever_it_begins) {
  EXPECT_EQ(choice("auto", slurm("1", "1", "7", "7")), "1/7");
  EXPECT_EQ(choice("auto", slurm("6", "0", "6", "7")), "7/7");
  EXPECT_EQ(choice("auto", slurm("14", "10", "18", "5", "2")), "3/5");
  EXPECT_EQ(
      choice("auto",
             {{"SGE_TASK_ID", "9"}, {"SGE_TASK_FIRST", "5"}, {"SGE_TASK_LAST", "12"}, {"SGE_TASK_STEPSIZE", "2"}}),
      "3/4");
}

TEST(ShardChoice, of_an_array_with_gaps_is_refused) {
  expect_refused(choice("auto", slurm("7", "1", "7", "3")), "SLURM_ARRAY_TASK_COUNT is 3, and the tasks 1 to 7 are 7");
  expect_refused(choice("auto", slurm("8", "1", "7", "7")), "is 8, which is none of 1 to 7 in steps of 1");
  expect_refused(choice("auto", slurm("3", "1", "7", "4", "0")), "in steps of 0");
}

TEST(ShardChoice, of_which_the_environment_says_half_is_refused) {
  expect_refused(choice("auto"), "no array job is known here");
  expect_refused(choice("auto", {{"SGE_TASK_ID", "undefined"}}), "no array job is known here");
  expect_refused(choice("auto", {{"CI_NODE_INDEX", "3"}}), "CI_NODE_TOTAL is not set");
  expect_refused(choice("auto", {{"CI_NODE_INDEX", "x"}, {"CI_NODE_TOTAL", "5"}}),
                 "CI_NODE_INDEX is 'x', which is no number");
  expect_refused(choice("auto", {{"SLURM_ARRAY_TASK_ID", "3"}}), "SLURM_ARRAY_TASK_MIN is not set");
  expect_refused(choice("auto", {{"JOB_COMPLETION_INDEX", "3"}}), "write --shard auto/N with the Job's completions");
}

TEST(ShardChoice, names_the_variable_that_says_a_wrong_number) {
  expect_refused(choice("auto", {{"CI_NODE_INDEX", "4"}, {"CI_NODE_TOTAL", "3"}}),
                 "auto: CI_NODE_INDEX is 4, which is none of 1 to 3 of 3 shards (GitLab)");
  expect_refused(choice("auto", {{"CI_NODE_INDEX", "1"}, {"CI_NODE_TOTAL", "0"}}),
                 "auto: CI_NODE_TOTAL makes 0 shards; it is 1 to 100000");
  expect_refused(choice("auto/4", {{"JOB_COMPLETION_INDEX", "4"}}),
                 "auto/4: JOB_COMPLETION_INDEX is 4, which is none of 0 to 3 of 4 shards (Kubernetes)");
  expect_refused(choice("auto", {{"AWS_BATCH_JOB_ARRAY_INDEX", "2"}}),
                 "write --shard auto/N with the array's size: AWS_BATCH_JOB_ARRAY_SIZE is not set");
}

TEST(ShardChoice, by_two_environments_is_taken_only_if_they_agree) {
  Variables both = slurm("2", "1", "4", "4");
  both.insert({"JOB_COMPLETION_INDEX", "1"});
  EXPECT_EQ(choice("auto", both), "2/4");
  both["JOB_COMPLETION_INDEX"] = "2";
  expect_refused(choice("auto", both),
                 "Slurm (SLURM_ARRAY_TASK_ID) says shard 2 of 4, and Kubernetes (JOB_COMPLETION_INDEX) says shard 3");
  expect_refused(choice("auto/9", slurm("2", "1", "4", "4")), "'auto/9' has 9 shards, and Slurm");
}

}  // namespace
}  // namespace clusterbench::cli
