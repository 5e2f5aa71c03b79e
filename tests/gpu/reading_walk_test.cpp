// Readings on the device against the structures on the host, sample for sample.

#include <gtest/gtest.h>

#include <bit>

#include "core/error.h"
#include "effort.h"
#include "gpu/reading/reading_check.h"
#include "gpu/reading_scenes.h"

namespace clusterbench::gpu {
namespace {

using assign::AssignerDescriptor;
using assign::testing::Setting;
using testing::Held;
using testing::Picture;

constexpr Walking k_walkings[] = {Walking::by_lane, Walking::by_light, Walking::by_cell};

class DeviceReadingWalks : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string obstacle = device_obstacle(); !obstacle.empty()) GTEST_SKIP() << "skipped: " << obstacle;
  }
};

// Of a picture in blocks of pixels, and of points anywhere. Returns the number of lights that were walked.
std::uint64_t expect_equal_walks(const Held& held, const Setting& setting) {
  std::uint64_t lights = 0;
  ReadingStructure structure(held.structure(), setting.grid, held.lights);
  const Picture picture(setting.frame, 16, 3);
  const std::vector<grid::Sample> points = testing::points_anywhere(setting.frame, 1000, 5);
  ReadingSamples of_picture(picture.samples, in_pixel_blocks(picture.image), setting.grid);
  ReadingSamples of_points(points, in_given_order(points.size()), setting.grid);
  for (ReadingSamples* samples : {&of_picture, &of_points})
    for (const Walking walking : k_walkings) {
      if (!structure.allows(walking)) continue;
      const ReadingCheck check = check_walk(structure, *samples, walking);
      EXPECT_EQ(check.differing, 0u) << held.name << ", walking " << static_cast<int>(walking) << ": " << check.first;
      const ReadingCheck own = check_own_lookup(structure, *samples, walking);
      EXPECT_EQ(own.differing, 0u) << held.name << ", walking " << static_cast<int>(walking) << ": " << own.first;
      EXPECT_GE(own.samples * 100, check.samples * 99) << held.name;
      lights += check.lights;
    }
  return lights;
}

// Each choice in a quarter of the views: software devices take long to compile.
TEST_F(DeviceReadingWalks, find_the_lights_of_every_storage_on_every_kind_of_grid) {
  std::size_t turn = 0;
  for (const char* method : {"exact", "box-bounds", "distance", "cascades", "world-grid"}) {
    const AssignerDescriptor& row = testing::method_named(method);
    for (const Setting& setting : assign::testing::settings_for(row, 11))
      for (const testing::StorageChoice& choice : test::every_nth(testing::storage_choices(), 4, turn++ % 4)) {
        const Held held = testing::stored(row, choice, setting);
        EXPECT_GT(expect_equal_walks(held, setting), 0u) << held.name;
      }
  }
}

TEST_F(DeviceReadingWalks, find_the_lights_of_indices_of_8_bits) {
  const AssignerDescriptor& row = testing::method_named("exact");
  const Setting setting = testing::with_few_lights(assign::testing::settings_for(row, 11).front());
  ASSERT_LE(setting.frame.lights.size(), 255u);
  for (const testing::StorageChoice& choice : testing::storage_choices())
    expect_equal_walks(testing::stored(row, choice, setting), setting);
}

// Their samples read lists with a lookup of their own, which no shader has yet.
bool has_own_lookup(const AssignerDescriptor& row) {
  return row.name == "tile-slices" || row.name == "naive-tile-size";
}

TEST_F(DeviceReadingWalks, find_the_lights_of_every_structure_that_a_method_leaves) {
  std::size_t structures = 0, turn = 0;
  for (const AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (row->make_own == nullptr) continue;
    for (const Setting& setting : test::every_nth(assign::testing::settings_for(*row, 13), 2, turn++ % 2)) {
      const Held held = testing::own_structure(*row, setting);
      const bool is_read = !row->draws_lights && !has_own_lookup(*row);
      EXPECT_EQ(held.structure().shader_buffers().has_value(), is_read) << row->name;
      if (!is_read) {
        EXPECT_THROW(ReadingStructure(held.structure(), setting.grid, held.lights), Error);
        continue;
      }
      ++structures;
      EXPECT_GT(expect_equal_walks(held, setting), 0u) << held.name;
    }
  }
  EXPECT_GT(structures, 15u);
}

TEST_F(DeviceReadingWalks, find_no_lights_where_there_are_none) {
  const AssignerDescriptor& row = testing::method_named("exact");
  Setting setting = assign::testing::settings_for(row, 11).front();
  setting.frame.lights.clear();
  setting.frame.count_types();
  for (const testing::StorageChoice& choice : testing::storage_choices())
    EXPECT_EQ(expect_equal_walks(testing::stored(row, choice, setting), setting), 0u);
  for (const char* method : {"bvh", "z-binning"})
    EXPECT_EQ(expect_equal_walks(testing::own_structure(testing::method_named(method), setting), setting), 0u);
}

// --- The bytes ---

void expect_bytes_of_a_frame(const Held& held) {
  const assign::ShaderBuffers shader = *held.structure().shader_buffers();
  EXPECT_EQ(shader.bytes(), held.structure().use().upload_bytes) << held.name;
  const std::vector<assign::BufferNeed> needs = held.structure().buffers();
  ASSERT_EQ(shader.buffers.size(), needs.size()) << held.name;
  for (std::size_t i = 0; i < needs.size(); ++i) {
    EXPECT_STREQ(shader.buffers[i].name, needs[i].name) << held.name;
    EXPECT_EQ(shader.buffers[i].bytes.size() % needs[i].element_bytes, 0u) << held.name << " " << needs[i].name;
  }
}

TEST_F(DeviceReadingWalks, upload_the_bytes_that_a_frame_uploads) {
  const AssignerDescriptor& row = testing::method_named("exact");
  const Setting setting = assign::testing::settings_for(row, 11).front();
  for (const testing::StorageChoice& choice : testing::storage_choices())
    expect_bytes_of_a_frame(testing::stored(row, choice, setting));
  for (const AssignerDescriptor* method : assign::assigner_descriptors()) {
    if (method->make_own == nullptr || method->draws_lights || method->on_device || has_own_lookup(*method)) continue;
    const Setting own = assign::testing::settings_for(*method, 11).front();
    expect_bytes_of_a_frame(testing::own_structure(*method, own));
  }
}

// --- What the check sees ---

// Gives shaders other bytes than the host reads.
class Altered final : public assign::LightStructure {
 public:
  Altered(const assign::LightStructure& of, std::size_t buffer) : of_(&of), buffer_(buffer) {}

  std::optional<assign::ShaderBuffers> shader_buffers() const override {
    std::optional<assign::ShaderBuffers> shader = of_->shader_buffers();
    std::vector<std::byte>& bytes = shader->buffers[buffer_].bytes;
    bytes[bytes.size() / 16 * 8] ^= std::byte{1};  // of an index, not of a link
    return shader;
  }
  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    return of_->lights_at(sample, way, out);
  }
  assign::Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    return of_->reads_at(sample, way);
  }
  assign::StructureUse use() const override { return of_->use(); }
  assign::StructureLimit limit() const override { return of_->limit(); }
  std::vector<assign::BufferNeed> buffers() const override { return of_->buffers(); }
  std::uint32_t index_bits() const override { return of_->index_bits(); }
  bool has_cells() const override { return of_->has_cells(); }
  void expand(assign::Lists& out) const override { of_->expand(out); }

 private:
  const assign::LightStructure* of_;
  std::size_t buffer_;
};

// A sample in each cell, so that the one with the changed bit is read.
std::vector<grid::Sample> samples_of_cells(const Setting& setting) {
  std::vector<grid::Sample> samples;
  const grid::ScreenGrid& grid = setting.grid.screen();
  for (std::uint32_t cell = 0; cell < setting.grid.cell_count(); ++cell) {
    const Vec3i at = setting.grid.cell_at(cell);
    const Vec2d pixel = (Vec2d(at.x, at.y) + 0.5) / Vec2d(grid.tiles.count) * Vec2d(setting.frame.viewport);
    const auto near = static_cast<double>(grid.slices.boundaries[static_cast<std::size_t>(at.z)]);
    const auto far = static_cast<double>(grid.slices.boundaries[static_cast<std::size_t>(at.z) + 1]);
    samples.push_back(testing::sample_at(setting.frame, pixel, (near + far) / 2.0));
  }
  return samples;
}

TEST_F(DeviceReadingWalks, differ_where_one_bit_of_a_structure_does) {
  const AssignerDescriptor& row = testing::method_named("exact");
  const Setting setting = assign::testing::settings_for(row, 11).front();
  const std::vector<grid::Sample> points = samples_of_cells(setting);
  ReadingSamples samples(points, in_given_order(points.size()), setting.grid);
  std::vector<Held> all;
  for (const char* storage : {"packed", "bitfield", "runs", "linked"})
    all.push_back(testing::stored(row, {storage, {}}, setting));
  for (const Held& held : all) {
    const Altered altered(held.structure(), 0);  // indices, words, runs, nodes
    ReadingStructure structure(altered, setting.grid, held.lights);
    for (const Walking walking : k_walkings) {
      const ReadingCheck check = check_walk(structure, samples, walking);
      EXPECT_GE(check.differing, 1u) << held.name << ", walking " << static_cast<int>(walking);
      EXPECT_NE(check.first, "");
    }
  }
}

// --- What is computed at a light ---

double lit_on_host(const view::LightArrays& lights, const std::vector<std::uint32_t>& list, const Vec3f& at) {
  double sum = 0.0;
  for (const std::uint32_t light : list) {
    const Vec3d away = Vec3d(lights.x[light], lights.y[light], lights.z[light]) - Vec3d(at);
    const double squared = glm::dot(away, away), range = static_cast<double>(lights.radius[light]);
    const double share = squared / (range * range), window = std::max(0.0, 1.0 - share * share);
    sum += window * window / (squared + 1.0);
  }
  return sum;
}

TEST_F(DeviceReadingWalks, add_the_attenuations_of_their_lights) {
  const AssignerDescriptor& row = testing::method_named("exact");
  const Setting setting = assign::testing::settings_for(row, 11).front();
  const Picture picture(setting.frame, 16, 3);
  ReadingSamples samples(picture.samples, in_pixel_blocks(picture.image), setting.grid);
  std::vector<Held> all;
  for (const char* storage : {"packed", "bitfield"}) all.push_back(testing::stored(row, {storage, {}}, setting));
  for (const char* own : {"bvh", "z-binning"})
    all.push_back(testing::own_structure(testing::method_named(own), setting));
  for (const Held& held : all) {
    ReadingStructure structure(held.structure(), setting.grid, held.lights);
    std::vector<std::uint32_t> alone;
    for (const Walking walking : k_walkings) {
      if (!structure.allows(walking)) continue;
      const std::vector<std::uint32_t> results = results_of({&structure, walking, ReadingOutput::lights}, samples);
      std::vector<std::uint32_t> list;
      std::size_t lit = 0, wrong = 0;
      for (std::uint32_t i = 0; i < samples.invocations(); ++i) {
        const grid::Sample* sample = samples.sample_of(i);
        if (sample == nullptr) continue;
        held.structure().lights_at(*sample, grid::Log2::rounded, list);
        const double expected = lit_on_host(held.lights, list, sample->view);
        const double found = static_cast<double>(std::bit_cast<float>(results[i]));
        lit += expected > 1e-3 ? 1 : 0;
        wrong += std::abs(found - expected) <= 1e-3 * expected + 1e-6 ? 0 : 1;
      }
      EXPECT_GT(lit, 100u);
      // Samples at a slice's boundary may be looked up beside it, and lack a light that another cell has.
      EXPECT_LE(wrong * 200, picture.samples.size()) << held.name << ", walking " << static_cast<int>(walking);
      if (walking == Walking::by_lane) alone = results;
      EXPECT_EQ(results, alone) << held.name << ", walking " << static_cast<int>(walking);
    }
  }
}

}  // namespace
}  // namespace clusterbench::gpu
