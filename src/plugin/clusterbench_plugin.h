/* The interface of clusterbench's plug-ins, version 1.0: methods that find the lights of each cell of a grid, in a
 * shared library of anybody. C99 and C++; needs no other file. docs/plugins.md begins with a complete plug-in.
 *
 * A plug-in exports one function, clusterbench_plugin_entry(). It returns data: the methods and their parameters, which
 * are read before anything runs. An instance of a method then gets a grid (build), and the lights of one frame after
 * the other (assign), and writes which lights each cell has to loop over. The program compares the lists with the exact
 * truth and takes the times.
 *
 * Versions. Each struct begins with struct_size, which is set by whoever makes it: sizeof of the struct that it knows.
 * New minor versions (1.1) add members at the ends of structs. Members beyond the other side's struct_size are not
 * there, and count as 0: CLUSTERBENCH_HAS() tells. So a program of any version 1.x loads a plug-in of any version 1.y.
 * Another major version is refused. What is not part of a version yet is an extension, found by its name
 * (clusterbench_host.extension). Names with ".draft." in them may change or go at any time.
 *
 * Memory. Whoever makes something keeps it. Arrays and structs that a function gets are valid until it returns, except
 * the grid, which is valid until the next build() or destroy() of that instance. A plug-in's own data
 * (clusterbench_plugin and all that it points to) must stay as they are until the process ends. Texts are UTF-8 and end
 * with 0.
 *
 * Threads. clusterbench_plugin_entry(): the main thread, once. create(), build(), assign(), destroy(): any thread;
 * calls for one instance never overlap, calls for two may. A method may use threads of its own inside of a call; where
 * it does, it has a parameter with CLUSTERBENCH_PARAMETER_THREADS.
 *
 * Errors. Functions return a clusterbench_status and write the reason into `error`. No C++ exception may leave a
 * function (clusterbench_plugin.hpp catches them all): one that leaves create(), build() or assign() fails the method,
 * one that leaves destroy() is a crash. A plug-in ends no process, and handles no signals.
 *
 * Rules. A call leaves what it did not make as it was: what it was given (structs and arrays of grids, frames, lights
 * and depth are to be read only), the thread that called it, that thread's mode of floating-point numbers (rounding,
 * denormals, traps), empty registers of the x87 (MMX code ends with emms), and what the process has once (working
 * directory, environment, limits, files of others). Other methods use them next. The program sets mode and registers
 * back after each call, and fails the method that changed them; it fails one that wrote to its inputs, where it finds
 * that: at the first call for each frame.
 *
 * Units: metres and radians. View space is right-handed, x to the right, y up, and the camera looks along -z: depth =
 * -z. Space of the lights and of box cells: view space for frustum and distance grids and cascades, the world's axes
 * relative to grid.origin for world grids. Matrices m[16] are in columns, for column vectors: m[4 * column + row]. */
#ifndef CLUSTERBENCH_PLUGIN_H
#define CLUSTERBENCH_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(readability-identifier-naming): names of C */

#define CLUSTERBENCH_PLUGIN_MAJOR 1u
#define CLUSTERBENCH_PLUGIN_MINOR 0u

/* Is this member there in a struct of the other side? */
#define CLUSTERBENCH_HAS(type, pointer, member) \
  ((pointer)->struct_size >= offsetof(type, member) + sizeof((pointer)->member))

#if defined(_WIN32)
#define CLUSTERBENCH_EXPORT __declspec(dllexport)
#else
#define CLUSTERBENCH_EXPORT __attribute__((visibility("default")))
#endif

typedef int32_t clusterbench_status;
enum {
  CLUSTERBENCH_OK = 0,
  CLUSTERBENCH_FAILED = 1, /* error.text says why */
  CLUSTERBENCH_OUT_OF_MEMORY = 2,
  CLUSTERBENCH_INVALID = 3, /* create(): parameters that the method does not have, or values that it does not take */
  CLUSTERBENCH_MORE = 4     /* assign(): lists.capacity is too small, and lists.count says how much is needed */
};

/* The reason of a failure, for people. Made by the program, empty; the plug-in writes at most capacity - 1 bytes and a
 * 0. */
typedef struct clusterbench_error {
  uint32_t struct_size;
  uint32_t capacity; /* bytes of text, at least 256 */
  char* text;
} clusterbench_error;

/* Kinds of grid, as bits. */
enum {
  CLUSTERBENCH_FRUSTUM = 1,  /* tiles of the picture x slices of depth */
  CLUSTERBENCH_DISTANCE = 2, /* tiles of the picture x shells of distance from the eye */
  CLUSTERBENCH_CASCADES = 4, /* nested boxes of cubes around the eye, in view space */
  CLUSTERBENCH_WORLD = 8     /* boxes along the world's axes */
};

/* Types of light, as bits. */
enum {
  CLUSTERBENCH_POINTS = 1, /* balls */
  CLUSTERBENCH_SPOTS = 2,  /* a ball's part within a cone whose apex is its centre */
  CLUSTERBENCH_BOXES = 4   /* oriented boxes: decals, probes */
};

/* What a method asks for, as bits. A program that does not know one of them does not run the method. */
enum {
  CLUSTERBENCH_NEEDS_DEPTH = 1 /* frame.depth */
};

/* What a method is, as bits. Those that a program does not know are ignored. */
enum {
  CLUSTERBENCH_CONSERVATIVE = 1, /* lists every light in every cell that it reaches; one that is missing fails the run.
                                    Not for methods that leave out what no visible surface needs */
  CLUSTERBENCH_EXACT = 2,        /* and in no other cell */
  CLUSTERBENCH_ORTHOGRAPHIC = 4, /* takes orthographic cameras, too */
  CLUSTERBENCH_ALL_PAIRS = 8,    /* tests every light against every cell: slow, for comparison */
  CLUSTERBENCH_BY_NAME = 16      /* runs only where it is named */
};

enum {
  CLUSTERBENCH_PARAMETER_FLAG = 1, /* number: 0 or 1 */
  CLUSTERBENCH_PARAMETER_NUMBER = 2,
  CLUSTERBENCH_PARAMETER_TEXT = 3 /* one of choices */
};

enum {
  CLUSTERBENCH_PARAMETER_WHOLE = 1,            /* a number without fraction */
  CLUSTERBENCH_PARAMETER_THREADS = 2,          /* the number of threads that share the work of assign() */
  CLUSTERBENCH_PARAMETER_CONSERVATIVE_FROM = 4 /* conservative_from holds */
};

/* A parameter of a method: what configurations may set. */
typedef struct clusterbench_parameter {
  uint32_t struct_size;
  uint32_t type;  /* CLUSTERBENCH_PARAMETER_FLAG, _NUMBER or _TEXT */
  uint32_t flags; /* CLUSTERBENCH_PARAMETER_WHOLE ... */
  uint32_t choice_count;
  const char* name;      /* lower-case letters, digits, '-' and '_', beginning with a letter; at most 64. Not "name" */
  const char* summary;   /* one line */
  const char* unit;      /* "m", "px"; NULL or "": none */
  double default_number; /* flags, numbers */
  double min, max;       /* numbers: both may be taken */
  double conservative_from; /* below it a method that is conservative is so no more; from min to max, and, where the
                               method says that it is conservative, not above the default */
  const char* default_text;
  const char* const* choices; /* texts: all that are allowed */
} clusterbench_parameter;

/* The value of a parameter. This struct never grows. */
typedef struct clusterbench_value {
  const char* name;
  const char* text; /* of a text; else NULL */
  double number;    /* of a number or a flag */
} clusterbench_value;

/* One frame's grid. Cells are numbered x fastest, then y, then z: cell = (z * cells[1] + y) * cells[0] + x. All numbers
 * of boundaries are exact: a cell is the set of points between them, and a light that touches it belongs to it. */
typedef struct clusterbench_grid {
  uint32_t struct_size;
  uint32_t kind; /* one of CLUSTERBENCH_FRUSTUM ... */
  uint32_t cells[3];
  uint32_t cell_count;   /* product of cells; at most 10^9 */
  uint32_t orthographic; /* 1: cells of tiles are boxes; else 0 */

  /* Boundaries, cells[i] + 1 numbers each; NULL for cascades.
   * Frustum and distance: x ascends from the left, y DESCENDS from the top of the picture: slopes x / depth and y /
   * depth, or metres with an orthographic camera. z ascends: depths, or distances from the eye. World: all ascend,
   * metres relative to origin along the world's axes. */
  const float* x;
  const float* y;
  const float* z;

  /* Frustum and distance. */
  uint32_t viewport[2];    /* pixels */
  uint32_t tile_pixels[2]; /* of a tile that is not clipped; 0: a number of tiles per picture */
  float tile_scale[2];     /* a shader's tile = (int)(pixel * tile_scale) */
  /* A shader's slice of a depth or distance d: 0: searches z; 1: (int)(d * scale + bias); 2: (int)(log2(d) * scale +
   * bias). With first_slice 1 depths below `first` are slice 0, and the formula counts from 1. */
  uint32_t slice_form;
  uint32_t first_slice;
  float slice_scale, slice_bias, first;

  /* Cascades: level l has cells[0] x cells[1] x (cells[2] / levels) cubes of the edge finest * 2^l; z = l * (cells[2] /
   * levels)
   * + the cube's number away from the eye. Cube (i, j, k) of a level spans x from (i - cells[0] / 2) * edge, y from
   * (cells[1] / 2 - j - 1) * edge, depth from k * edge. Cubes inside of the next finer level are holes: they have a
   * number, no space and no lights. */
  uint32_t levels;
  float finest;

  double origin[3]; /* world grids: in the world; else 0 */
} clusterbench_grid;

/* A frame's camera. */
typedef struct clusterbench_frame {
  uint32_t struct_size;
  uint32_t viewport[2];  /* pixels */
  uint32_t orthographic; /* 1, or 0: perspective */
  int32_t index;         /* in the camera's path, from 0 */
  double time;           /* seconds */
  /* The picture's rectangle in view space: at depth 1, or anywhere (orthographic). far may be infinite. */
  double left, right, bottom, top, near_plane, far_plane;
  double eye[3];              /* in the world */
  double view_from_world[16]; /* rigid */
  double clip_from_view[16];  /* depth from 0 (near) to 1 (far) */
  /* With CLUSTERBENCH_NEEDS_DEPTH: of each pixel, row by row from the top left, the depth of the first opaque surface
   * in metres; infinite without one. Else NULL. */
  const float* depth;
} clusterbench_frame;

/* The lights of a frame: points, then spots, then boxes. Their numbers in lists are their places in this order, from 0.
 * A light whose radius is 0 reaches nothing. No number is NaN; a radius may be infinite.
 *
 * In single precision, in the grid's space: each coordinate is rounded to nearest, each radius up. What a light reaches
 * is decided by the exact numbers, so a method that must not lose any adds to a radius what rounding may have moved:
 * twice 2^-24 * reach covers the numbers given here, and each operation of its own may add as much as 2^-24 * reach. */
typedef struct clusterbench_lights {
  uint32_t struct_size;
  uint32_t point_count, spot_count, box_count;
  /* Of all lights: centre or apex, radius, and reach = |x| + |y| + |z| + radius. The radius of a box is that of the
   * ball around it. */
  const float *x, *y, *z, *radius, *reach;
  /* Of spots, from the first spot on: axis, of length 1 up to rounding, and half-angle of the cone, at most pi / 2. */
  const float *axis_x, *axis_y, *axis_z, *cos_angle, *sin_angle;
  /* Of boxes, from the first box on: 9 numbers, three half axes from the middle to the middles of three faces. */
  const float* half_axes;

  /* The exact numbers, in the world, of all lights. Each pointer is to the first light's; the next light's is
   * world_stride bytes on. NULL if unknown. world_half_axes: 9 numbers. The exact position in the grid's space is
   * space_rotation * (position - space_origin); space_rotation[3 * row + column]. */
  size_t world_stride;
  const double *world_position, *world_radius, *world_axis, *world_angle, *world_half_axes;
  double space_origin[3], space_rotation[9];
} clusterbench_lights;

/* What assign() fills. The lights of cell c are lights[begin[c]] .. lights[begin[c + 1] - 1]: points before spots
 * before boxes, each once, otherwise in any order. All is made by the program; arrays hold whatever was there before.
 */
typedef struct clusterbench_lists {
  uint32_t struct_size;
  uint32_t cell_count;
  uint32_t* begin;  /* cell_count + 1 numbers; begin[0] = 0 */
  uint32_t* lights; /* room for `capacity` numbers */
  uint64_t capacity;
  /* Written by the method. The last three are at most 2^48 each. */
  uint64_t count;      /* of numbers in lights: begin[cell_count]. With CLUSTERBENCH_MORE the capacity that is needed */
  uint64_t tests_done; /* tests of lights against cells, tiles or nodes, for whoever compares methods by them; 0: not
                          counted */
  uint64_t fallbacks;  /* pairs that single precision could not decide, if the method goes on then */
  uint64_t scratch_bytes; /* memory that this instance holds */
} clusterbench_lists;

/* A method. */
typedef struct clusterbench_method {
  uint32_t struct_size;
  uint32_t grid_kinds;  /* CLUSTERBENCH_FRUSTUM ... */
  uint32_t light_types; /* CLUSTERBENCH_POINTS ...; in scenes with lights of other types it is skipped */
  uint32_t needs;       /* CLUSTERBENCH_NEEDS_DEPTH */
  uint32_t flags;       /* CLUSTERBENCH_CONSERVATIVE ... */
  uint32_t parameter_count;
  const char*
      name; /* lower-case letters, digits and '-', beginning with a letter; at most 64. Users name it PLUGIN.NAME */
  const char* summary; /* one line: in which cells it lists a light */
  const char* source;  /* paper, engine or address */
  const clusterbench_parameter* const* parameters;

  /* Makes an instance with these values, one for each parameter, in their order; clusterbench_check_values() tells
   * whether they are. On success *instance is what the other functions get; it may be NULL. */
  clusterbench_status (*create)(const struct clusterbench_method* method, const clusterbench_value* values,
                                uint32_t value_count, void** instance, clusterbench_error* error);
  /* Called before assign() and whenever the grid changes, with the types of light that frames may bring. Does all that
   * does not depend on a frame. Timed as the build. */
  clusterbench_status (*build)(void* instance, const clusterbench_grid* grid, uint32_t light_types,
                               clusterbench_error* error);
  /* The lists of one frame, which depend on its arguments and the grid alone. Timed as the assignment. After
   * CLUSTERBENCH_MORE the same frame comes again, with as much room as was asked for or more: at most every light in
   * every cell. That happens while memory grows, and not in what is timed; nor should a method allocate there. */
  clusterbench_status (*assign)(void* instance, const clusterbench_frame* frame, const clusterbench_lights* lights,
                                clusterbench_lists* lists, clusterbench_error* error);
  void (*destroy)(void* instance);
} clusterbench_method;

/* The program that loads a plug-in. Valid until the process ends. */
typedef struct clusterbench_host {
  uint32_t struct_size;
  uint32_t major, minor; /* of the interface */
  const char* name;      /* "clusterbench" */
  const char* version;   /* its own: "0.1.0" */
  /* Finds what the program has beyond this version of the interface, by its name. NULL: it has no such thing. */
  const void* (*extension)(const char* name);
} clusterbench_host;

/* Extension "clusterbench.log": a line on standard error, for finding mistakes. Any thread. */
#define CLUSTERBENCH_LOG "clusterbench.log"
typedef struct clusterbench_log {
  uint32_t struct_size;
  void (*write)(const char* text);
} clusterbench_log;

/* A plug-in. The first three members are the same in all versions of the interface. */
typedef struct clusterbench_plugin {
  uint32_t struct_size;
  uint32_t major, minor; /* CLUSTERBENCH_PLUGIN_MAJOR, CLUSTERBENCH_PLUGIN_MINOR */
  uint32_t method_count; /* 1 to 64 */
  const char* id;        /* like a method's name; the first part of its methods' names for users */
  const char* name;      /* for people */
  const char* version;   /* of the plug-in: "2.1"; at most 64 letters */
  const clusterbench_method* const* methods;
} clusterbench_plugin;

/* The one exported symbol. NULL: the plug-in cannot work with this program. */
CLUSTERBENCH_EXPORT const clusterbench_plugin* clusterbench_plugin_entry(const clusterbench_host* host);

/* For create(): are these the method's parameters, in their order? Otherwise `error` names the first that is not, and
 * create() returns what this returns. */
static inline clusterbench_status clusterbench_check_values(const clusterbench_method* method,
                                                            const clusterbench_value* values, uint32_t value_count,
                                                            clusterbench_error* error) {
  static const char k_unknown[] = "no parameter of this method, or not in its place: ";
  const char *name = "(too few, or too many)", *expected;
  uint32_t i = 0, at = 0;
  for (; i < value_count && i < method->parameter_count; ++i) {
    uint32_t c = 0;
    name = values[i].name;
    expected = method->parameters[i]->name;
    while (name[c] != 0 && name[c] == expected[c]) ++c;
    if (name[c] != expected[c]) break;
    name = "(too few, or too many)";
  }
  if (i == value_count && i == method->parameter_count) return CLUSTERBENCH_OK;
  for (i = 0; k_unknown[i] != 0 && at + 1 < error->capacity; ++i) error->text[at++] = k_unknown[i];
  for (i = 0; name[i] != 0 && at + 1 < error->capacity; ++i) error->text[at++] = name[i];
  if (error->capacity > 0) error->text[at] = 0;
  return CLUSTERBENCH_INVALID;
}

/* NOLINTEND(readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
