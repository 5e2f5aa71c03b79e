#pragma once
// A method of a plug-in as an assigner. The lists' memory is the program's; what the plug-in writes there is checked
// before anything reads it.

#include <array>
#include <memory>
#include <string>

#include "assign/contract/assigner.h"
#include "os/call_notes.h"
#include "plugin/kept_inputs.h"
#include "plugin/plugin_call.h"
#include "plugin/read_plugin.h"

namespace clusterbench::plugin {

class PluginMethod final : public assign::ListAssigner {
 public:
  // `facts` must outlive this object; `file`: the plug-in's, for messages. Throws MethodError if the method refuses the
  // values.
  PluginMethod(const MethodFacts& facts, std::string file, const assign::Params& params);
  ~PluginMethod() override;
  PluginMethod(const PluginMethod&) = delete;
  PluginMethod& operator=(const PluginMethod&) = delete;

  using assign::ListAssigner::build;
  void build(const grid::Grid& grid, const assign::LightKinds& kinds) override;
  void assign(const assign::FrameInput& input, assign::Lists& out) override;
  void check(const assign::Lists& lists, const view::LightRanges& ranges) const override;

  std::uint64_t tests_done() const override { return last_.tests_done; }
  std::uint64_t fallbacks() const override { return last_.fallbacks; }
  std::size_t scratch_bytes() const override { return last_.scratch_bytes; }

 private:
  // How one of its functions came back.
  struct Returned {
    clusterbench_status status = CLUSTERBENCH_FAILED;  // also where an exception left it
    CallEnd end;
  };
  template <class Function>
  Returned call(os::CallStep step, bool looks_at_files, const Function& function) const;
  void create(const assign::Params& params);
  void destroy() const;
  // Throws MethodError unless the method succeeded, without an exception, and no call of the plug-in has forked.
  void expect_success(const Returned& left, const char* doing) const;
  [[noreturn]] void fail(const std::string& message) const;
  void expect_mode(const CallEnd& end, const char* doing) const;
  // Whether this is the first time that this frame comes: it is not timed.
  bool is_first_of(int frame);
  KeptInputs kept(const assign::FrameInput& input) const;
  void refuse_written(const KeptInputs& before, const char* doing) const;
  void fill_lists(const assign::FrameInput& input, const clusterbench_frame& frame, const clusterbench_lights& lights,
                  assign::Lists& out);
  // One call. False if there was too little room.
  bool fill(const clusterbench_frame& frame, const clusterbench_lights& lights, assign::Lists& out);

  const MethodFacts& facts_;
  std::string file_;
  std::array<char, 1024> text_{};
  clusterbench_error error_{};
  clusterbench_grid grid_{};      // as the plug-in sees it, and may have written to it
  std::uint32_t cell_count_ = 0;  // of the grid
  clusterbench_lists last_{};
  os::Caller caller_;
  KeptInputs kept_grid_;
  std::vector<bool> seen_;                      // frames, by their index
  int frame_ = -1;                              // that is assigned
  bool is_first_ = false;                       // ... for the first time
  mutable std::vector<std::uint32_t> checked_;  // of check()
  std::uint64_t unused_ = 0;                    // the most room that it has asked for and not filled
  void* instance_ = nullptr;
};

// The values of a method's parameters as create() gets them. Refers to both arguments.
std::vector<clusterbench_value> values_of(std::span<const assign::ParamSpec> specs, const assign::Params& params);

}  // namespace clusterbench::plugin
