// Methods that fit no list per cell, and methods of a test, through whole configurations.

#include <gtest/gtest.h>

#include <algorithm>

#include "gpu/device/device.h"
#include "run/runner.h"

namespace clusterbench::run {
namespace {

// Every light at every sample of the grid's reach, or, without cells, anywhere.
template <bool has_cells_of_grid>
class AllLights final : public assign::LightStructure {
 public:
  void start(const grid::Grid& grid, std::uint32_t lights) {
    grid_ = &grid;
    lights_ = lights;
  }
  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    out.clear();
    if (has_cells_of_grid && grid::lookup(*grid_, sample, way) < 0) return false;
    for (std::uint32_t light = 0; light < lights_; ++light) out.push_back(light);
    return true;
  }
  assign::Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    return has_cells_of_grid && grid::lookup(*grid_, sample, way) < 0 ? assign::Reads{} : assign::Reads::of(1, 4);
  }
  assign::StructureUse use() const override {
    assign::StructureUse use;
    use.index_entries = 1;
    use.index_bytes = use.upload_bytes = 4;
    return use;
  }
  assign::StructureLimit limit() const override { return {1, 4}; }
  std::vector<assign::BufferNeed> buffers() const override { return {{"words", 4, 1, 1}}; }
  std::uint32_t index_bits() const override { return 32; }
  bool has_cells() const override { return has_cells_of_grid; }
  void expand(assign::Lists& out) const override {
    out = {{0}, {}};
    for (std::uint32_t cell = 0; cell < grid_->cell_count(); ++cell) {
      for (std::uint32_t light = 0; light < lights_; ++light) out.lights.push_back(light);
      out.begin.push_back(out.pair_count());
    }
  }

 private:
  const grid::Grid* grid_ = nullptr;
  std::uint32_t lights_ = 0;
};

template <bool has_cells>
class GivesAll : public assign::AssignerOf<AllLights<has_cells>> {
 public:
  void build(const grid::Grid& grid, const assign::LightKinds&) override { grid_ = &grid; }
  void fill(const assign::FrameInput& input, AllLights<has_cells>& out) override {
    out.start(*grid_, input.lights.size());
  }
  std::uint64_t tests_done() const override { return 1; }
  std::size_t scratch_bytes() const override { return 8; }

 private:
  const grid::Grid* grid_ = nullptr;
};

template <bool has_cells>
assign::AssignerDescriptor all_lights() {
  return {.name = has_cells ? "all-lights" : "all-lights-anywhere",
          .summary = "every light everywhere",
          .source = "forward rendering",
          .kinds = {grid::Kind::frustum},
          .params = {},
          .make_own = [](const assign::Params&) -> std::unique_ptr<assign::StructureAssigner> {
            return std::make_unique<GivesAll<has_cells>>();
          }};
}

// A method whose device says what it took.
class OnDevice final : public GivesAll<true> {
 public:
  const assign::DeviceSpans* device_spans() const override { return &spans_; }
  void repeat_on_device(const assign::DeviceRepeats& repeats) override {
    is_cold_ = repeats.caches == assign::DeviceRepeats::Caches::cold;
    spans_.run_ns = is_cold_ ? 2000.0 : 1000.0;
  }
  std::optional<double> device_build_ns() override { return is_cold_ ? 70.0 : 7.0; }

 private:
  double device_floor_ns() override { return 500.0; }

  bool is_cold_ = false;
  assign::DeviceSpans spans_{100.0, 2000.0, 30.0, 3, 64};
};

// A method whose device is lost.
class OnLostDevice final : public GivesAll<true> {
 public:
  void fill(const assign::FrameInput&, AllLights<true>&) override { throw gpu::DeviceError("the device was lost"); }
};

// aabb's lists, each type's lights from the last to the first.
class Backwards final : public assign::ListAssigner {
 public:
  explicit Backwards(const assign::Params& params) : aabb_(assign::find_assigner("aabb")->make(params)) {}
  void build(const grid::Grid& grid, const assign::LightKinds& kinds) override { aabb_->build(grid, kinds); }
  void assign(const assign::FrameInput& input, assign::Lists& out) override {
    aabb_->assign(input, out);
    for (std::uint32_t cell = 0; cell < out.cell_count(); ++cell) {
      const auto begin = out.lights.begin() + out.begin[cell], end = out.lights.begin() + out.begin[cell + 1];
      const auto spots = std::lower_bound(begin, end, input.lights.spots.first);
      std::reverse(begin, spots);
      std::reverse(spots, end);
    }
  }
  std::uint64_t tests_done() const override { return aabb_->tests_done(); }
  std::size_t scratch_bytes() const override { return aabb_->scratch_bytes(); }

 private:
  std::unique_ptr<assign::ListAssigner> aabb_;
};

assign::AssignerDescriptor backwards() {
  assign::AssignerDescriptor descriptor = *assign::find_assigner("aabb");
  descriptor.name = "backwards";
  descriptor.make = [](const assign::Params& params) -> std::unique_ptr<assign::ListAssigner> {
    return std::make_unique<Backwards>(params);
  };
  return descriptor;
}

struct Ran {
  Plan plan;
  Result result;

  const CaseResult& of(const std::string& assigner, const std::string& storage) const {
    for (const CaseResult& one : result.cases)
      if (one.assigner == assigner && one.storage_label == storage) return one;
    throw std::runtime_error("no case of " + assigner + " in " + storage);
  }
};

constexpr int k_rig_lights = 60;

Ran ran(const std::string& rest) {
  const config::Config config = config::parse_config(R"({"scenes": [{"rig": {"lights": 60, "spots": 0.4, "range": 20}}],
      "viewport": [160, 90], "grids": [{"tiles": {"count": [5, 4]}, "slices": {"count": 6, "near": 0.1, "far": 60}}],
      "timing": {"sweep_mib": 4, "rounds": 2, "min_time_ms": 0.01, "frames": 1}, )" +
                                                         rest + "}",
                                                     "c.json");
  Ran out{make_plan(config, ""), {}};
  const std::atomic<bool> stop{false};
  out.result = run_plan(config, out.plan, {}, {}, stop);
  return out;
}

TEST(LightStructures, a_method_registered_at_run_time_goes_through_a_whole_configuration) {
  const assign::AssignerRegistration registration(all_lights<true>());
  const Ran all = ran(R"("assigners": ["all-lights", "aabb"], "storages": ["packed", "bitfield"],
      "lookup": {"samples": 200}, "details": {}, "stability": {"steps": 3})");
  ASSERT_EQ(all.result.cases.size(), 3u) << "the axis of storages is not its own";
  EXPECT_TRUE(all.plan.skipped.empty());
  const CaseResult& own = all.of("all-lights", "own");
  EXPECT_TRUE(own.name.ends_with("/all-lights/no lists")) << own.name;
  ASSERT_TRUE(own.error);
  EXPECT_EQ(own.error->false_negatives, 0u);
  EXPECT_EQ(own.error->reported_pairs, 5u * 4u * 6u * k_rig_lights);
  EXPECT_EQ(own.occupancy->pairs.mean, 5.0 * 4.0 * 6.0 * k_rig_lights);
  EXPECT_EQ(own.shading->missed, all.of("aabb", "packed").shading->missed);
  EXPECT_EQ(own.shading->needed, all.of("aabb", "packed").shading->needed);
  EXPECT_EQ(own.shading->evaluated % k_rig_lights, 0u);
  EXPECT_GT(own.shading->evaluated, all.of("aabb", "packed").shading->evaluated);
  EXPECT_EQ(own.buffers.bytes.high_water, 4u);
  EXPECT_EQ(own.buffers.scratch_bytes, 8u);
  EXPECT_TRUE(own.stability);
  EXPECT_TRUE(own.details);
  EXPECT_EQ(own.lookup.front().needed, all.of("aabb", "packed").lookup.front().needed);
  ASSERT_TRUE(own.timing);
  EXPECT_FALSE(own.timing->convert_ns) << "there are no lists to convert";
  EXPECT_TRUE(all.of("aabb", "bitfield").timing->convert_ns);
  EXPECT_EQ(own.timing->assign_ns.samples.size(), 2u);
}

TEST(LightStructures, without_cells_samples_alone_are_measured) {
  const assign::AssignerRegistration registration(all_lights<false>());
  const Ran all = ran(R"("assigners": ["all-lights-anywhere", "aabb"], "details": {}, "stability": {"steps": 3})");
  const CaseResult& own = all.of("all-lights-anywhere", "own");
  EXPECT_FALSE(own.occupancy || own.error || own.details || own.stability);
  EXPECT_FALSE(own.buffers.worst_cell);
  EXPECT_EQ(own.shading->missed, 0u);
  EXPECT_EQ(own.shading->evaluated, own.shading->samples * k_rig_lights);
  EXPECT_TRUE(all.of("aabb", "packed").error && all.of("aabb", "packed").details);
}

TEST(LightStructures, a_method_that_cannot_run_here_is_skipped_with_its_reason) {
  assign::AssignerDescriptor descriptor = all_lights<true>();
  descriptor.unavailable = [](const assign::Params&) { return std::string("there is no device"); };
  const assign::AssignerRegistration registration(descriptor);
  const Ran all = ran(R"("assigners": ["all-lights", "aabb"])");
  ASSERT_EQ(all.result.skipped.size(), 1u);
  EXPECT_TRUE(all.result.skipped[0].name.ends_with("/all-lights")) << all.result.skipped[0].name;
  EXPECT_EQ(all.result.skipped[0].reason, "all-lights cannot run here: there is no device");
  EXPECT_EQ(all.result.cases.size(), 1u);
}

TEST(LightStructures, a_device_that_fails_ends_the_cases_of_that_method_alone) {
  assign::AssignerDescriptor works = all_lights<true>(), fails = works;
  works.name = "works";
  works.make_own = [](const assign::Params&) -> std::unique_ptr<assign::StructureAssigner> {
    return std::make_unique<OnDevice>();
  };
  fails.name = "fails";
  fails.make_own = [](const assign::Params&) -> std::unique_ptr<assign::StructureAssigner> {
    return std::make_unique<OnLostDevice>();
  };
  works.on_device = fails.on_device = true;
  const assign::AssignerRegistration first(works), second(fails);
  const Ran all = ran(R"("assigners": ["works", "fails", "aabb"])");
  EXPECT_EQ(all.result.cases.size(), 2u);
  EXPECT_TRUE(all.of("works", "own").device);
  EXPECT_TRUE(all.of("aabb", "packed").timing);
  ASSERT_EQ(all.result.skipped.size(), 1u);
  EXPECT_TRUE(all.result.skipped[0].name.ends_with("/fails/no lists")) << all.result.skipped[0].name;
  EXPECT_EQ(all.result.skipped[0].reason, "the device was lost");
}

TEST(LightStructures, a_device_tells_its_spans_by_its_own_clock) {
  assign::AssignerDescriptor descriptor = all_lights<true>();
  descriptor.make_own = [](const assign::Params&) -> std::unique_ptr<assign::StructureAssigner> {
    return std::make_unique<OnDevice>();
  };
  descriptor.on_device = true;
  const assign::AssignerRegistration registration(descriptor);
  const Ran all = ran(R"("assigners": ["all-lights", "aabb"])");
  EXPECT_FALSE(all.of("all-lights", "own").timing) << "the time of a process that waits";
  const std::optional<DeviceTimes>& device = all.of("all-lights", "own").device;
  ASSERT_TRUE(device);
  ASSERT_TRUE(device->is_cold());
  EXPECT_EQ(device->cold->upload_ns.samples, (std::vector<double>{100.0, 100.0})) << "two rounds, per frame";
  EXPECT_EQ(device->cold->run_ns.median, 2000.0);
  EXPECT_EQ(device->cold->readback_ns.median, 30.0);
  EXPECT_EQ(device->cold->floor_ratio, 4.0);
  EXPECT_EQ(device->warm.run_ns.samples, (std::vector<double>{1000.0, 1000.0}));
  EXPECT_EQ(device->warm.floor_ratio, 2.0);
  EXPECT_EQ(device->build_ns->samples, (std::vector<double>{70.0, 70.0})) << "the cold ones";
  EXPECT_EQ(device->dispatches, 3.0);
  EXPECT_EQ(device->launches, 1);
  EXPECT_TRUE(device->clock_mhz.empty());
  EXPECT_FALSE(all.of("aabb", "packed").device);
  EXPECT_TRUE(all.of("aabb", "packed").timing);
}

TEST(LightStructures, lists_in_any_order_measure_as_ascending_ones) {
  const assign::AssignerRegistration registration(backwards());
  const Ran both = ran(R"("assigners": ["aabb", "backwards"], "storages": ["packed", "bitfield", "linked"],
      "lookup": {"samples": 200}, "stability": {"steps": 3})");
  for (const char* storage : {"packed", "bitfield", "linked"}) {
    const CaseResult &as = both.of("aabb", storage), &back = both.of("backwards", storage);
    EXPECT_EQ(back.error->false_negatives, 0u);
    EXPECT_EQ(back.error->false_positives, as.error->false_positives);
    EXPECT_EQ(back.shading->evaluated, as.shading->evaluated) << storage;
    EXPECT_EQ(back.shading->missed, as.shading->missed) << storage;
    EXPECT_EQ(back.lookup.front().missed, as.lookup.front().missed) << storage;
    EXPECT_EQ(back.stability->method, as.stability->method);
    EXPECT_EQ(back.buffers.bytes.high_water, as.buffers.bytes.high_water);
  }
}

TEST(LightStructures, samples_miss_what_a_storage_dropped) {
  const Ran all = ran(R"("assigners": ["aabb"], "storages": ["packed", {"name": "fixed", "cap": 1}])");
  const CaseResult &packed = all.of("aabb", "packed"), &fixed = all.of("aabb", "fixed(cap=1)");
  EXPECT_GT(fixed.buffers.dropped_pairs, 0u);
  EXPECT_GT(fixed.shading->missed, packed.shading->missed);
  EXPECT_EQ(fixed.error->false_negatives, 0u) << "no fault of the assigner";
  EXPECT_EQ(fixed.shading->missed_outside, packed.shading->missed_outside);
  ASSERT_EQ(fixed.failures.size(), 1u);
  EXPECT_EQ(fixed.failures[0].kind, Failure::Kind::dropped_pairs);
  EXPECT_TRUE(packed.failures.empty());
  const Ran allowed = ran(R"("assigners": ["aabb"], "storages": [{"name": "fixed", "cap": 1}],
      "limits": {"dropped_pairs": null})");
  EXPECT_TRUE(allowed.result.cases.at(0).failures.empty());
}

TEST(LightStructures, a_method_of_both_forms_has_a_case_for_each) {
  const Ran all = ran(R"("assigners": ["bvh"], "storages": ["packed", "fixed"])");
  ASSERT_EQ(all.result.cases.size(), 3u);
  const CaseResult &lists = all.of("bvh", "packed"), &own = all.of("bvh", "own");
  EXPECT_EQ(lists.error->false_negatives, 0u);
  EXPECT_FALSE(own.error);
  EXPECT_EQ(own.shading->missed, 0u);
  EXPECT_EQ(own.shading->needed, lists.shading->needed);
  EXPECT_NE(own.id, lists.id);
  EXPECT_TRUE(own.timing->against_first);
  EXPECT_EQ(method_label(config::parse_config(R"({"scenes": ["a.glb"], "assigners": ["bvh"]})", "c.json"),
                         all.plan.groups[0].cases[2].method()),
            "bvh (no lists)");
}

}  // namespace
}  // namespace clusterbench::run
