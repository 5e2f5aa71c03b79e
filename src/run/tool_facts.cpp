// Facts of a result about the tool and the machine that made it.

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "assign/lists/list_builder.h"
#include "os/machine.h"
#include "run/findings/run_result.h"
#include "run/git_sha.h"

namespace clusterbench::run {
namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string compiler() {
#if defined(__clang__)
  return "clang " + dotted(__clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return std::string("g++ ") + __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

ToolFacts tool_facts() {
  return {.version = CLUSTERBENCH_VERSION,
          .git_sha = CLUSTERBENCH_GIT_SHA,
          .compiler = compiler(),
          .flags = CLUSTERBENCH_FLAGS,
          .build_type = CLUSTERBENCH_BUILD_TYPE,
          .simd_target = assign::simd_target_name(),
          .libraries = {CLUSTERBENCH_LIBRARIES{"glm", dotted(GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
                        {"nlohmann_json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                                 NLOHMANN_JSON_VERSION_PATCH)}}};
}

MachineFacts machine_facts() {
  const os::Machine machine = os::this_machine();
  MachineFacts facts;
  facts.cpu = machine.processor.name;
  facts.family = machine.processor.family;
  facts.model = machine.processor.model;
  facts.stepping = machine.processor.stepping;
  facts.caches = machine.caches;
  facts.cores = machine.cores;
  facts.ram_bytes = machine.ram_bytes;
  facts.os = machine.system;
  return facts;
}

}  // namespace clusterbench::run
