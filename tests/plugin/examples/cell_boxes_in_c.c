/* A plug-in in C99: a light is listed in the cells whose bounding box its ball touches, in frustum grids. Every light
 * against every cell. */

#include "clusterbench_plugin.h"

#include <stdlib.h>
#include <string.h>

typedef struct box {
  float lo[3], hi[3];
} box;

typedef struct instance {
  uint32_t cell_count;
  box* boxes;
} instance;

static float least(float a, float b) {
  return a < b ? a : b;
}
static float most(float a, float b) {
  return a > b ? a : b;
}

/* The box around the part of a tile between two depths: its corners are products of slopes and depths. */
static box box_of(const clusterbench_grid* grid, uint32_t column, uint32_t row, uint32_t slice) {
  const float x0 = grid->x[column], x1 = grid->x[column + 1];
  const float y0 = grid->y[row + 1], y1 = grid->y[row];
  const float near_depth = grid->z[slice], far_depth = grid->z[slice + 1];
  const box out = {{least(x0 * near_depth, x0 * far_depth), least(y0 * near_depth, y0 * far_depth), -far_depth},
                   {most(x1 * near_depth, x1 * far_depth), most(y1 * near_depth, y1 * far_depth), -near_depth}};
  return out;
}

static clusterbench_status create(const clusterbench_method* method, const clusterbench_value* values,
                                  uint32_t value_count, void** made, clusterbench_error* error) {
  const clusterbench_status known = clusterbench_check_values(method, values, value_count, error);
  if (known != CLUSTERBENCH_OK) return known;
  *made = calloc(1, sizeof(instance));
  return *made == NULL ? CLUSTERBENCH_OUT_OF_MEMORY : CLUSTERBENCH_OK;
}

static clusterbench_status build(void* given, const clusterbench_grid* grid, uint32_t light_types,
                                 clusterbench_error* error) {
  instance* self = given;
  box* boxes = realloc(self->boxes, grid->cell_count * sizeof(box));
  uint32_t cell = 0, column, row, slice;
  (void)light_types;
  (void)error;
  if (boxes == NULL) return CLUSTERBENCH_OUT_OF_MEMORY;
  self->boxes = boxes;
  self->cell_count = grid->cell_count;
  for (slice = 0; slice < grid->cells[2]; ++slice)
    for (row = 0; row < grid->cells[1]; ++row)
      for (column = 0; column < grid->cells[0]; ++column) boxes[cell++] = box_of(grid, column, row, slice);
  return CLUSTERBENCH_OK;
}

static int touches(const box* b, const float center[3], float radius) {
  float sum = 0.0f;
  int axis;
  for (axis = 0; axis < 3; ++axis) {
    const float apart = most(most(b->lo[axis] - center[axis], center[axis] - b->hi[axis]), 0.0f);
    sum += apart * apart;
  }
  return sum <= radius * radius;
}

/* Roundings, in units of 2^-24 of a light's reach: 2 of the numbers that are given, 1 of a box's coordinate and 1 of a
 * difference on each axis, which makes less than 4 of their length, and less than 2 of squares, sums and the
 * comparison: 8. */
static clusterbench_status assign(void* given, const clusterbench_frame* frame, const clusterbench_lights* lights,
                                  clusterbench_lists* out, clusterbench_error* error) {
  const float k_padding = 8.0f / 16777216.0f;
  const instance* self = given;
  const uint32_t light_count = lights->point_count + lights->spot_count;
  uint64_t count = 0;
  uint32_t cell, light;
  (void)frame;
  (void)error;
  for (cell = 0; cell < self->cell_count; ++cell) {
    out->begin[cell] = (uint32_t)count;
    for (light = 0; light < light_count; ++light) {
      const float center[3] = {lights->x[light], lights->y[light], lights->z[light]};
      const float radius = lights->radius[light];
      if (!(radius > 0.0f) || !touches(&self->boxes[cell], center, radius + k_padding * lights->reach[light])) continue;
      if (count < out->capacity) out->lights[count] = light;
      ++count;
    }
  }
  out->begin[self->cell_count] = (uint32_t)count;
  out->count = count;
  out->tests_done = (uint64_t)light_count * self->cell_count;
  out->scratch_bytes = sizeof(instance) + self->cell_count * sizeof(box);
  return count > out->capacity ? CLUSTERBENCH_MORE : CLUSTERBENCH_OK;
}

static void destroy(void* given) {
  instance* self = given;
  free(self->boxes);
  free(self);
}

const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host) {
  static const clusterbench_method method = {sizeof(clusterbench_method),
                                             CLUSTERBENCH_FRUSTUM,
                                             CLUSTERBENCH_POINTS | CLUSTERBENCH_SPOTS,
                                             0,
                                             CLUSTERBENCH_CONSERVATIVE | CLUSTERBENCH_ALL_PAIRS,
                                             0,
                                             "cell-boxes",
                                             "all cells whose bounding box is touched by its ball",
                                             "an example",
                                             NULL,
                                             create,
                                             build,
                                             assign,
                                             destroy};
  static const clusterbench_method* const methods[] = {&method};
  static const clusterbench_plugin plugin = {sizeof(clusterbench_plugin),
                                             CLUSTERBENCH_PLUGIN_MAJOR,
                                             CLUSTERBENCH_PLUGIN_MINOR,
                                             1,
                                             "in-c",
                                             "An example in C",
                                             "1.0",
                                             methods};
  (void)host;
  return &plugin;
}
