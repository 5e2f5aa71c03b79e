// An engine of the tests, built against an installed tree: reads settings, a view and lights, prints the lists.
//
//   input   threads columns rows slices slicing kind method
//           width height eye (3) left right bottom top near far
//           points spots, then each point (position, range) and spot (position, range, direction, angle)
//   output  what begins() and light_indices() have, a line each. Fails if a steady frame allocates.

#include <clusterbench/assign.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

namespace light = clusterbench::library;

namespace {

std::atomic<unsigned> allocations{0};

double number() {
  double value = 0.0;
  if (std::scanf("%lf", &value) != 1) std::exit(3);
  return value;
}
int whole() {
  return static_cast<int>(number());
}

template <class Light>
void read_ball(Light& light) {
  for (float& coordinate : light.position) coordinate = static_cast<float>(number());
  light.range = static_cast<float>(number());
}

void print(std::span<const std::uint32_t> numbers) {
  for (const std::uint32_t value : numbers) std::printf("%u ", value);
  std::printf("\n");
}

int fail(std::string_view why) {
  std::fprintf(stderr, "%.*s\n", static_cast<int>(why.size()), why.data());
  return 2;
}

}  // namespace

// All forms that the library or the standard library may call.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size != 0 ? size : 1)) return memory;
  std::abort();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto step = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
  std::abort();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

int main() {
  light::Settings settings;
  settings.threads = whole();
  settings.grid.columns = whole(), settings.grid.rows = whole(), settings.grid.slices = whole();
  settings.grid.slicing = static_cast<light::Grid::Slicing>(whole());
  settings.grid.kind = static_cast<light::Grid::Kind>(whole());
  char method[64];
  if (std::scanf("%63s", method) != 1) return 3;
  settings.method = method;
  settings.storage = "packed";
  light::LightLists lists;
  if (!lists.start(settings)) return fail(lists.error());

  light::View view;
  view.width = whole(), view.height = whole();
  for (double& coordinate : view.eye) coordinate = number();
  for (double* side : {&view.left, &view.right, &view.bottom, &view.top, &view.near_m, &view.far_m}) *side = number();
  const int point_count = whole(), spot_count = whole();
  std::vector<light::PointLight> points(static_cast<std::size_t>(point_count));
  std::vector<light::SpotLight> spots(static_cast<std::size_t>(spot_count));
  for (light::PointLight& point : points) read_ball(point);
  for (light::SpotLight& spot : spots) {
    read_ball(spot);
    for (float& coordinate : spot.direction) coordinate = static_cast<float>(number());
    spot.outer_angle = static_cast<float>(number());
  }

  const light::Lights frame{points, spots, {}};
  for (int warm = 0; warm < 2; ++warm)
    if (!lists.update(view, frame)) return fail(lists.error());
  const unsigned before = allocations;
  for (int steady = 0; steady < 20; ++steady)
    if (!lists.update(view, frame)) return fail(lists.error());
  if (allocations != before) return fail("a steady frame allocates");
  print(lists.begins());
  print(lists.light_indices());
  return 0;
}
