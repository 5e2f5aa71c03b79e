#include "run/findings/broken_cases.h"

#include "core/text.h"

namespace clusterbench::run {
namespace {

std::optional<std::string> text_if_any(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

// Where another plug-in, or a thread of one, could have written.
bool is_of_memory(const assign::MethodError& error) {
  for (const char* fault : {"left lists that are none", " wrote to ", "says that it wrote "})
    if (error.message().find(fault) != std::string::npos) return true;
  return false;
}

}  // namespace

std::string frame_text(int frame) {
  return frame < 0 ? "" : "frame " + std::to_string(frame);
}

std::string suspects_text(const std::vector<std::string>& made, const std::string& blamed) {
  std::vector<std::string> others = made;
  std::erase(others, blamed);
  if (others.empty()) return "";
  return std::string("; the plug-in") + (others.size() == 1 ? " " : "s ") + joined(others) +
         " ran in the same process, and can have written to its memory: --assigner with this method alone tells";
}

result::BrokenCase broken_case(const config::Config& config, const Plan& plan, const CasePlan& case_plan,
                               const Breakdown& breakdown) {
  const SceneData& scene = plan.scenes[case_plan.scene];
  result::BrokenCase out;
  out.id = case_plan.id;
  out.settings = case_plan.settings;
  out.name = case_plan.name;
  out.scene = scene.scene.name;
  out.camera = scene.paths[case_plan.camera].camera;
  out.preset = text_if_any(case_plan.preset);
  out.method = config.assigners[case_plan.assigner].name;
  out.plugin = text_if_any(method_of(config, case_plan).plugin);
  out.kind = breakdown.kind;
  out.reason = breakdown.reason;
  out.step = os::name_of(breakdown.step);
  if (breakdown.frame >= 0) out.frame = static_cast<std::uint64_t>(breakdown.frame);
  out.pass = text_if_any(breakdown.pass);
  out.signal = text_if_any(breakdown.signal);
  return out;
}

Breakdown breakdown_of(const assign::MethodError& error, const std::string& plugin) {
  const os::LastCall call = os::last_call();
  const std::string frame = frame_text(call.frame);
  return {"failed",
          "the plug-in " + plugin + ": " + error.message() + " (" + os::name_of(call.step) +
              (frame.empty() ? "" : ", " + frame) + ")" +
              (is_of_memory(error) ? suspects_text(os::codes_that_made(), plugin) : ""),
          call.step,
          call.frame,
          call.pass,
          ""};
}

}  // namespace clusterbench::run
