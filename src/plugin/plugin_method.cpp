#include "plugin/plugin_method.h"

#include <algorithm>

#include "assign/contract/method_error.h"
#include "core/memory.h"
#include "core/text.h"
#include "plugin/plugin_call.h"
#include "plugin/views.h"

namespace clusterbench::plugin {
namespace {

constexpr std::uint64_t k_first_capacity = 1u << 16;
// Of tests, fallbacks and bytes of one frame: sums over frames stay exact, and no method gets there.
constexpr std::uint64_t k_most_counted = std::uint64_t{1} << 48;
constexpr int k_most_seen = 1 << 16;

std::string name_of(clusterbench_status status) {
  switch (status) {
    case CLUSTERBENCH_FAILED:
      return "failed";
    case CLUSTERBENCH_OUT_OF_MEMORY:
      return "had too little memory";
    case CLUSTERBENCH_INVALID:
      return "found its parameters invalid";
    case CLUSTERBENCH_MORE:
      return "asked for more room, which only assign() may";
    default:
      return "returned the unknown status " + std::to_string(status);
  }
}

// Every light in every cell.
std::uint64_t most_pairs(std::uint32_t cell_count, const view::LightRanges& lights) {
  return std::uint64_t{cell_count} * lights.size();
}

// The struct itself, which the plug-in sees until the next build, and the boundaries, which the grid owns.
KeptInputs kept_of(const clusterbench_grid& grid) {
  KeptInputs out;
  out.keep("the grid's struct", &grid, 1);
  if (grid.x != nullptr) out.keep("grid.x", grid.x, grid.cells[0] + std::size_t{1});
  if (grid.y != nullptr) out.keep("grid.y", grid.y, grid.cells[1] + std::size_t{1});
  if (grid.z != nullptr) out.keep("grid.z", grid.z, grid.cells[2] + std::size_t{1});
  return out;
}

}  // namespace

std::vector<clusterbench_value> values_of(std::span<const assign::ParamSpec> specs, const assign::Params& params) {
  std::vector<clusterbench_value> values;
  for (const assign::ParamSpec& spec : specs) {
    const assign::ParamValue& value = params.values().at(spec.name);
    clusterbench_value& out = values.emplace_back(clusterbench_value{spec.name.c_str(), nullptr, 0.0});
    if (const auto* text = std::get_if<std::string>(&value)) out.text = text->c_str();
    if (const auto* flag = std::get_if<bool>(&value)) out.number = *flag ? 1.0 : 0.0;
    if (const auto* number = std::get_if<double>(&value)) out.number = *number;
  }
  return values;
}

PluginMethod::PluginMethod(const MethodFacts& facts, std::string file, const assign::Params& params)
    : facts_(facts), file_(std::move(file)), caller_{os::note_code(facts.descriptor.plugin), os::noted_label()} {
  error_ = {sizeof error_, static_cast<std::uint32_t>(text_.size()), text_.data()};
  create(params);
}

PluginMethod::~PluginMethod() {
  destroy();
}

void PluginMethod::destroy() const {
  CallEnd end;  // what is not as before is set back; a destructor fails no more
  called(caller_, os::CallStep::destroy, -1, end, [&] {
    expect_return("destroy()", [&] { facts_.table.destroy(instance_); });
    os::end_if_files_are_lost();
  });
}

template <class Function>
PluginMethod::Returned PluginMethod::call(os::CallStep step, bool looks_at_files, const Function& function) const {
  Returned out;
  called(caller_, step, step == os::CallStep::assign ? frame_ : -1, out.end, [&] {
    returned(out.end, [&] { out.status = function(); });
    if (looks_at_files) os::end_if_files_are_lost();
  });
  return out;
}

void PluginMethod::create(const assign::Params& params) {
  const std::vector<clusterbench_value> values = values_of(facts_.descriptor.params, params);
  const Returned left = call(os::CallStep::create, true, [&] {
    const auto count = static_cast<std::uint32_t>(values.size());
    return facts_.table.create(facts_.own, values.data(), count, &instance_, &error_);
  });
  expect_success(left, "create()");
  if (left.end.keeps_mode && left.end.empties_numbers) return;
  destroy();
  expect_mode(left.end, "create()");
}

void PluginMethod::fail(const std::string& message) const {
  throw assign::MethodError(file_, facts_.descriptor.name, message);
}

void PluginMethod::expect_success(const Returned& left, const char* doing) const {
  if (!os::is_guarded())  // else the guard ends this process
    if (const auto step = os::forked_step_of(caller_.code))
      fail(std::string("came back twice from ") + os::name_of(*step) + ": it forked");
  if (!left.end.exception.empty()) fail("an exception left " + std::string(doing) + ": " + left.end.exception);
  if (left.status == CLUSTERBENCH_OK) return;
  const std::string reason(text_.data(), strnlen(text_.data(), text_.size()));
  fail(std::string(doing) + " " + name_of(left.status) + (reason.empty() ? "" : ": " + printable(reason)));
}

void PluginMethod::expect_mode(const CallEnd& end, const char* doing) const {
  if (!end.keeps_mode)
    fail(std::string(doing) +
         " left another rounding mode, or other denormals or traps, of floating-point numbers; allowed: the mode that "
         "it was called with");
  if (!end.empties_numbers)
    fail(std::string(doing) +
         " left the x87 registers in use (MMX code without emms); allowed: empty ones, as it was called with");
}

void PluginMethod::refuse_written(const KeptInputs& before, const char* doing) const {
  const std::string names = before.put_back();
  if (!names.empty()) fail(std::string(doing) + " wrote to " + names + ", which is to be read only");
}

void PluginMethod::build(const grid::Grid& grid, const assign::LightKinds& kinds) {
  grid_ = view_of(grid);
  cell_count_ = grid_.cell_count;
  text_.front() = '\0';
  kept_grid_ = kept_of(grid_);
  const Returned left = call(os::CallStep::build, true,
                             [&] { return facts_.table.build(instance_, &grid_, light_types_of(kinds), &error_); });
  refuse_written(kept_grid_, "build()");
  expect_success(left, "build()");
  expect_mode(left.end, "build()");
}

bool PluginMethod::fill(const clusterbench_frame& frame, const clusterbench_lights& lights, assign::Lists& out) {
  last_ = {sizeof last_, cell_count_, out.begin.data(), out.lights.data(), out.lights.size(), 0, 0, 0, 0};
  text_.front() = '\0';
  const Returned left = call(os::CallStep::assign, is_first_,
                             [&] { return facts_.table.assign(instance_, &frame, &lights, &last_, &error_); });
  if (left.status != CLUSTERBENCH_MORE) expect_success(left, "assign()");
  expect_mode(left.end, "assign()");
  if (left.status == CLUSTERBENCH_MORE) return false;
  if (last_.count > out.lights.size())
    fail("says that it wrote " + std::to_string(last_.count) + " pairs where there is room for " +
         std::to_string(out.lights.size()));
  return true;
}

bool PluginMethod::is_first_of(int frame) {
  if (frame < 0 || frame >= k_most_seen) return false;
  const auto index = static_cast<std::size_t>(frame);
  if (index < seen_.size() && seen_[index]) return false;
  if (index >= seen_.size()) seen_.resize(index + 1);
  return seen_[index] = true;
}

KeptInputs PluginMethod::kept(const assign::FrameInput& input) const {
  KeptInputs out = kept_grid_;
  const view::LightArrays& lights = input.lights;
  const auto keep = [&](const char* name, const auto& array) { out.keep(name, array.data(), array.size()); };
  keep("lights.x", lights.x);
  keep("lights.y", lights.y);
  keep("lights.z", lights.z);
  keep("lights.radius", lights.radius);
  keep("lights.reach", lights.reach);
  keep("lights.axis_x", lights.axis_x);
  keep("lights.axis_y", lights.axis_y);
  keep("lights.axis_z", lights.axis_z);
  keep("lights.cos_angle", lights.cos_angle);
  keep("lights.sin_angle", lights.sin_angle);
  keep("lights.half_axes", lights.half_axes);
  keep("lights.world_position and what follows it", lights.source);
  if (input.depth != nullptr) keep("frame.depth", input.depth->nearest);
  return out;
}

void PluginMethod::assign(const assign::FrameInput& input, assign::Lists& out) {
  is_first_ = is_first_of(input.frame.index);
  frame_ = input.frame.index;
  const clusterbench_frame frame = view_of(input.frame, input.depth);
  const clusterbench_lights lights = view_of(input.lights);
  if (!is_first_) {
    fill_lists(input, frame, lights, out);
    return;
  }
  KeptInputs before = kept(input);
  before.keep("the frame's struct", &frame, 1);
  before.keep("the lights' struct", &lights, 1);
  try {
    fill_lists(input, frame, lights, out);
  } catch (...) {
    before.put_back();
    throw;
  }
  refuse_written(before, "assign()");
}

void PluginMethod::fill_lists(const assign::FrameInput& input, const clusterbench_frame& frame,
                              const clusterbench_lights& lights, assign::Lists& out) {
  const std::uint64_t most = most_pairs(cell_count_, input.lights);
  out.begin.resize(cell_count_ + std::size_t{1});
  // Lists that were made before have room for the same frame again. So while a frame is timed again and again, the
  // method is called once, and no memory is made or cleared.
  const bool is_new = out.lights.capacity() == 0;
  std::uint64_t capacity = std::min(most, is_new ? k_first_capacity : out.lights.size() + unused_);
  std::uint64_t asked = 0;
  for (out.lights.resize(capacity); !fill(frame, lights, out); out.lights.resize(capacity)) {
    asked = last_.count;
    if (asked <= capacity || asked > most)
      fail("asks for room for " + std::to_string(asked) + " pairs where it has room for " + std::to_string(capacity) +
           ", and all lights in all cells are " + std::to_string(most));
    capacity = std::min(most, std::max(asked, capacity + capacity / 2));
    check_memory("pairs of light lists", capacity, sizeof(std::uint32_t));
  }
  if (asked > last_.count) unused_ = std::max(unused_, asked - last_.count);
  if (out.begin.front() != 0 || out.begin.back() != last_.count)
    fail("says that it wrote " + std::to_string(last_.count) + " pairs, but its lists begin at " +
         std::to_string(out.begin.front()) + " and end at " + std::to_string(out.begin.back()));
  out.lights.resize(last_.count);
}

void PluginMethod::check(const assign::Lists& lists, const view::LightRanges& ranges) const {
  const auto check_number = [this](const char* name, std::uint64_t number) {
    if (number > k_most_counted)
      fail(std::string(name) + " is " + std::to_string(number) + ", allowed: at most 2^48 (" +
           std::to_string(k_most_counted) + ")");
  };
  check_number("tests_done", last_.tests_done);
  check_number("fallbacks", last_.fallbacks);
  check_number("scratch_bytes", last_.scratch_bytes);
  const std::string fault = assign::lists_fault(lists, cell_count_, ranges, checked_);
  if (!fault.empty()) fail("left lists that are none: " + fault);
}

}  // namespace clusterbench::plugin
