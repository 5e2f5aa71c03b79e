// On the device: one invocation per cell, over all lights, in one pass: each cell has room for the same number of
// lights, and those that find none are dropped and counted.
#include "assign/storages/fixed.h"
#include "gpu/methods/descriptors.h"
#include "gpu/methods/device_floor.h"
#include "gpu/methods/device_frame.h"
#include "gpu/methods/device_lists.h"
#include "gpu/methods/repeated_work.h"

namespace clusterbench::gpu {
namespace {

class CellsFixed final : public assign::StructureAssigner {
 public:
  explicit CellsFixed(const assign::Params& params)
      : form_{.cap = static_cast<std::uint32_t>(params.number("cap")), .index_bits = 32, .is_uploaded = false},
        frame_(params),
        floor_(frame_.device()),
        fill_(frame_.device().kernel("cells", k_group, Mode::fixed)) {}

  std::unique_ptr<assign::LightStructure> make_structure() const override {
    return std::make_unique<assign::FixedLists>(form_);
  }

  void build(const grid::Grid& grid, const assign::LightKinds& kinds) override {
    grid_ = &grid;
    frame_.build(grid, kinds);
    frame_.buffers().reserve(Binding::counts, grid.cell_count() * k_word, "counts of cells");
    frame_.buffers().reserve(Binding::lists, entries() * k_word, "lists of fixed length");
  }

  void assign(const assign::FrameInput& input, assign::LightStructure& out) override {
    auto& lists = static_cast<assign::FixedLists&>(out);
    lists.start(*grid_, input.lights);
    spans_ = {};
    tests_ = 0;
    if (input.lights.boxes.first > 0) fill_lists(input.lights, lists);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::vector<assign::ShaderStatistic> shader_statistics() const override { return frame_.statistics_of({fill_}); }
  const assign::DeviceSpans* device_spans() const override { return &spans_; }
  void repeat_on_device(const assign::DeviceRepeats& repeats) override { frame_.repeat(repeats); }
  double device_floor_ns() override { return floor_.measured_ns(frame_.buffers(), spans_, frame_.repeats()); }
  std::optional<double> device_build_ns() override { return frame_.device_build_ns(); }
  std::size_t scratch_bytes() const override { return frame_.host_bytes() + frame_.buffers().all_bytes(); }

 private:
  static constexpr std::uint32_t k_group = 64;
  static constexpr std::uint64_t k_word = sizeof(std::uint32_t);

  std::uint64_t entries() const { return std::uint64_t{grid_->cell_count()} * form_.cap; }

  void fill_lists(const view::LightArrays& lights, assign::FixedLists& out) {
    frame_.prepare(lights);
    FrameArguments arguments = frame_.arguments();
    arguments.capacity = form_.cap;
    const std::uint64_t dropped_bytes = arguments.words * k_word;
    frame_.buffers().reserve(Binding::dropped, dropped_bytes, "bits of dropped lights");
    Commands commands(frame_.device(), frame_.buffers());
    RepeatedWork work(commands, frame_.repeats());
    work.record([&] { frame_.upload(commands); },
                [&] {
                  commands.fill(Binding::dropped, 0, dropped_bytes);
                  commands.barrier();
                  commands.dispatch(fill_, arguments, groups_for(arguments.cells, k_group));
                });
    commands.download(Binding::counts, arguments.cells * k_word);
    commands.download(Binding::lists, entries() * k_word);
    commands.download(Binding::dropped, dropped_bytes);
    commands.run();
    spans_ = work.spans();
    tests_ = std::uint64_t{arguments.cells} * arguments.lights;
    out.take(commands.downloaded(0), commands.downloaded(1), commands.downloaded(2));
    spans_.result_bytes = (out.use().index_entries + arguments.cells) * k_word;
  }

  assign::FixedLists::Form form_;
  DeviceFrame frame_;
  DeviceFloor floor_;
  Kernel fill_;
  const grid::Grid* grid_ = nullptr;
  std::uint64_t tests_ = 0;
  assign::DeviceSpans spans_;
};

}  // namespace

assign::AssignerDescriptor gpu_cells_fixed_descriptor() {
  std::vector<assign::ParamSpec> params{assign::cap_param()};
  for (assign::ParamSpec& param : device_params()) params.push_back(std::move(param));
  return {
      .name = "gpu-cells-fixed",
      .summary =
          "on the GPU, an invocation per cell over all lights, in one pass: every cell has room for the same number of "
          "lights; what does not fit is dropped, the highest light indices first",
      .source = "DaveH355, three.js",
      .kinds = {grid::Kind::frustum},
      .conservative = false,  // what is dropped is missing
      .all_pairs = true,
      .own_lists = true,
      .by_name = true,
      .on_device = true,
      .params = std::move(params),
      .make_own = assign::make_structure_assigner<CellsFixed>,
      .unavailable = no_device,
  };
}

}  // namespace clusterbench::gpu
