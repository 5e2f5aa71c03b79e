// Made by types.mjs of the records of src/result: change those, and run `node types.mjs`.

export type Tool = {
  version: string; // Version of clusterbench
  git_sha: string; // Commit that was built; with + where files differed from it
  compiler: string; // Name and version
  flags: string; // The compiler's flags
  build_type: string; // CMake's build type; only Release gives times worth comparing
  simd_target: string; // Instruction set that Highway chose
  libraries: Record<string, string>; // Version of each library
};

export type Machine = {
  cpu: string; // The processor's name
  family?: string; // The vendor's number, on ARM the implementer's; absent if unknown
  model?: string; // On ARM the part; absent if unknown
  stepping?: string; // On ARM variant and revision, r3p1; absent if unknown
  caches?: Record<string, number>; // Those that the first core uses; absent if unknown [bytes, over the first core]
  cores: number; // Logical ones [cores, over the machine]
  ram_bytes: number; // Main memory [bytes, over the machine]
  clock_mhz?: {
    now: number; // Mean when the run began [over all cores]
    max?: number; // The highest that the system allows; absent if it does not say [over the first core]
  }; // The processor's clock; absent if unknown, and where nothing is timed [MHz]
  load?: {
    begin: number; // Just before the run
    end: number; // Just after; a run adds its own threads
  }; // Programs that run or wait to run. Absent where nothing is timed [programs, over one minute, the machine]
  os: string; // System, kernel and architecture
  host?: string; // Of a result: start of the SHA-256 of the machine's name, by which `merge` keeps times of two machines of one kind apart. Absent where nothing is timed or counted in instructions, and where the machine does not tell its name
};

// [x, y, z]
export type Vector = [number, number, number];

// Percentiles are nearest-rank: values that occur
export type Spread = {
  mean: number | null; // Arithmetic mean
  p50: number | null; // Median
  p95: number | null; // 95th percentile
  p99: number | null; // 99th percentile
  max: number | null; // Largest
};

// Cell as [x, y, z]
export type Cell = [number, number, number];

export type HighWater = {
  high_water: number; // Largest of all frames
  theoretical_max: number; // If every light were in every cell
  recommended: number; // What to allocate: high water x allocation.margin of the configuration, at most theoretical_max
};

export type MeanMax = {
  mean: number | null; // Arithmetic mean
  max: number | null; // Largest
};

// What a shader would loop over at the points of a set
export type SampleSet = {
  samples: number; // Points of the set [samples]
  unanswered?: number; // Samples at which the light structure has no answer: outside of its cells, beside the picture, behind the eye [samples]
  evaluated: number; // Lights that the light structure gives at the samples [lights]
  needed: number; // Lights that reach the samples [lights]
  missed: number; // Of needed, those that the light structure does not give, for any reason: no pair, dropped, or outside of the grid [lights]
  missed_in_cells?: number; // Of missed, at samples inside of the grid: the cell lacks the light, or its storage dropped it [lights]
  missed_outside?: number; // Of missed, at samples outside of the grid, mostly beyond its far end [lights]
  unlit: number | null; // missed / needed, 0 to 1; null where nothing is needed [share of 1]
  lost_irradiance: number | null; // Share of the irradiance (lux, on a surface that faces the light) that missed lights carry: intensity times the colour's luminance (Rec. 709), attenuated as KHR_lights_punctual has it, with the range's window and a spot's falloff. Without directional lights [share of 1]
  lost_lux?: number | null; // Irradiance that missed lights carry, mean over the samples [lx]
  overshade: number | null; // evaluated / needed over all samples; null where it cannot be compared: fewer than 100 lights are needed, or more than 0.001 of them are missed [ratio]
  reads?: number; // Elements of the light structure's buffers that shaders fetch at the samples to know their lights: headers, light indices, words of bits, nodes, runs, boxes. The lights themselves are not among them [elements]
  read_bytes?: number; // Bytes of these elements [B]
  worst_frame?: {
    frame: number; // Number of the frame on the camera's path, from 0 [frame, over one frame]
    missed: number; // Missed lights at this frame's samples [lights, over one frame]
    needed: number; // Needed lights at this frame's samples [lights, over one frame]
  }; // The frame that misses most; absent where none is missed
  darkest?: {
    frame: number; // Number of the frame on the camera's path, from 0 [frame, over one sample]
    lost_lux: number | null; // Irradiance that the sample loses [lx, over one sample]
    pixel?: [number, number]; // Its position in the picture, from the top left; absent behind the eye [px, over one sample]
  }; // The sample that loses most light; absent where none is lost
  ground_m?: number; // Height of the horizontal plane (the world's y) on which these samples lie, since the scene has no triangles; absent where they lie on its surfaces [m, over the whole run]
  waves?: Array<{
    lanes: number; // Pixels of a wave: 32 (8 x 4) or 64 (8 x 8) [pixels, over one wave]
    waves: number; // With a surface in one of their pixels at least; only such pixels count [waves]
    distinct_lists: {
      mean: number | null; // Of a wave [lists]
      max: number; // Of a wave [lists]
    }; // Different lists within a wave
    mean_list: number | null; // Length of a wave's lists, mean over its lanes and then over waves: steps if no lane waited for another [lights]
    longest_list: number | null; // Longest list of a wave, mean over waves: steps until its last lane is done [lights]
    united_lists: number | null; // Lights that any lane of a wave has, mean over waves: steps of a loop that all lanes share (scalarised) [lights]
    divergence: number | null; // Sum over waves of the longest list by the sum of the mean ones; 1: no lane waits [ratio]
    scalarised: number | null; // Sum over waves of the united lists by the sum of the mean ones [ratio]
  }>; // Lists among pixels that a GPU shades together; of visible surfaces at full resolution (divisor 1) [over the waves of all frames]
};

export type DepthLengths = {
  tiles: number; // With a visible pixel, summed over the frames [tiles]
  pixels: number; // In these tiles [pixels]
  tiled: Lengths; // One list per tile, from its nearest to its farthest surface
  tiled_2_5d: Lengths; // Of the 32 equal parts of that range, those that hold a surface (Harada 2012)
  clusters: Lengths; // The slice of the pixel's cell
  explicit_clusters: Lengths; // In the pixel's cell, from its nearest to its farthest surface
};

// Of depth, along the view's -z
export type Lengths = {
  mean: number | null; // Of the pixels; null without pixels, as all of these
  p50: number | null; // Half of the pixels have at most this; p50, p90 and p99 are rounded up, by a sixteenth at most
  p90: number | null; // 90 % have at most this
  p99: number | null; // 99 % have at most this
  max: number | null; // The longest
};

export type Churn = {
  total: number; // Sum over all steps
  mean: number | null; // Mean per step
  max: number; // In the step with the most
};

export type Extremes = {
  min: number | null; // Smallest
  mean: number | null; // Mean
  max: number | null; // Largest
};

export type FitSide = {
  pairs?: number; // In lists, mean per frame; absent without cells [pairs]
  true_pairs?: number; // Over all frames; absent without cells, or where accuracy is not checked [pairs]
  false_positives?: number; // Over all frames: pairs in lists that are not true [pairs]
  lists_changed?: number | null; // Share of the lists that differ from those of the same cells in the frame before; absent without cells, null with one frame [share]
  index_entries: number; // High-water mark [entries]
  bytes: number; // High-water mark of all that is allocated [bytes]
  evaluated: Record<string, number>; // Lights that samples loop over, by the set of samples [lights]
  missed: Record<string, number>; // Lights that samples need and do not get, by the set of samples [lights]
};

export type Saved = {
  pairs?: number | null; // Pairs in lists, mean per frame
  false_positives?: number | null; // Pairs that are not true
  lists_changed?: number | null; // Lists that differ from the frame before's
  index_entries: number | null; // High-water mark of the entries to allocate
  bytes: number | null; // High-water mark of all bytes to allocate
  evaluated: Record<string, number | null>; // Lights that samples loop over, by the set of samples
};

export type BeforeAfter = {
  before: number; // Before
  after: number; // After
  removed: number | null; // Share that is taken out; null where there is none [share of 1]
};

export type Time = {
  median: number | null; // Median
  mad: number | null; // Median absolute deviation
  min: number | null; // Time of the fastest round
  p95: number | null; // 95th percentile
  ci95: Interval; // 95 % interval of the median
  samples: Array<number | null>; // One per round, in the order measured
};

// 95 % interval, [low, high]: of times Student's t between three launches or more, or the bootstrap of six rounds or more of one; null where it is unknown
export type Interval = [number | null, number | null];

export type DeviceRepeats = {
  upload: number; // Of upload_ns
  run: number; // Of run_ns
  floor: number; // Of floor_ns
};

export type PerFrame = {
  assign: number; // Instructions of assignment, with the builds that the frames need
  convert?: number; // Instructions of conversion to the storage; absent where a method leaves its own structure
  pre_cull?: number; // Instructions of the pre-cull; absent where there is none
  frame?: number; // Instructions of pre-cull, assignment and conversion together; absent in older results, and of cycles
};

// What `clusterbench run` writes. x-unit and x-over of a number, or of what holds it: its unit, and what it is taken over. x-written: keys that this version always writes, and that older results of the same schema_version may lack. null: not a number.
export type Result = {
  schema_version: 2; // Grows whenever a name or a meaning changes [version, over the file]
  name: string; // The configuration's name
  date?: string; // When the run began: UTC, ISO 8601. Absent where nothing is timed, so that such results are the same whenever they are made
  command?: string; // The command line. Absent where nothing is timed
  tool: Tool; // The program that measured
  plugins?: Array<{
    id: string; // First part of the names of its methods: ID.METHOD
    name: string; // For people
    version: string; // Its own
    file: string; // Its name, without its folder
    sha256: string; // Hash of the file: another one is another build
    interface_version: string; // That it was made for, as 1.0
  }>; // Shared libraries that cases' methods come from. Absent without any
  shard?: {
    index: number; // Its number, from 1 [shards, over the run]
    count: number; // Of all shards of the run [shards, over the run]
    sweep: string; // SHA-256 of what all of its shards have in common: program, configuration, baseline, filter, scenes, cases
    filter?: string; // That selected the run's cases (--filter); absent without one
    host?: string; // Of earlier builds, which wrote it here: now `machine.host`
    cases: number; // Of this result, when it was written: `merge` counts them [cases, over the result]
    baseline?: {
      file: string; // As the shard opened it: relative to the folder that it ran in
      sha256: string; // SHA-256 of the file: `merge` takes no other
    }; // The result that `merge` holds all cases against (--baseline, limits.baseline); absent without one
  }; // The result is this part of a run (`run --shard`), and `clusterbench merge` makes one result of all parts. Absent: it is whole
  machine: Machine; // Where it was measured; with `machines` the kind of the first of them
  machines?: Array<{
    name: string; // Of `machine` of its cases: machine 1, machine 2 ...
    machine: Machine; // As `machine` of a result
    simd_target: string; // As `tool.simd_target`
    host?: string; // As `machine.host` of a result; absent where it is not known
  }>; // Of a merged result the machines whose times, device's times or instructions it has; those of two are never compared, and every one has ranks, fronts and conclusions of its own. Absent where it is one
  device?: {
    name: string; // Its name, from its driver
    driver: string; // Name and version
    vulkan: string; // Version of Vulkan
    uuid: string; // 32 hexadecimal digits
    type: "discrete GPU" | "integrated GPU" | "virtual GPU" | "software" | "other"; // software: a driver that computes on the processor: its times are no GPU's, and nothing ranks by them
    max_buffer_bytes: number; // Largest buffer that a shader can see [bytes, over one buffer]
    max_group_size: number; // Largest group of a shader [invocations, over one group]
    shared_bytes: number; // Shared memory [bytes, over one group]
    subgroup_size: number; // Invocations that run in step [invocations, over one subgroup]
    timestamp_bits: number; // Of its clock; 0: it has none [bits, over the clock]
    timestamp_period_ns: number | null; // Between two ticks of its clock [ns, over the clock]
    rounds_to_nearest: boolean; // Whether shaders can ask for it. If not, methods count the error of each step twice, and pad lights by it
    arithmetic?: {
      rounding: "to_nearest" | "either_way" | "wrong"; // Of sums and products. either_way: to the next number on either side of the exact result
      contracts: boolean; // A product and a sum were rounded once, though shaders forbid it
      reorders: boolean; // A sum of three was not made in its order
      flushes_denormals: boolean; // Results below the least normal number became 0, which is allowed
      division_ulp: number | null; // Largest error of a quotient; readings allow for 2.5 [ulp, over the numbers]
      sqrt_ulp: number | null; // Largest error of a root; readings allow for 4.5 [ulp, over the numbers]
      log2_ulp: number | null; // Largest error of a logarithm of numbers beyond [0.5, 2]; readings allow for 3 [ulp, over the numbers]
      log2_error: number | null; // The same of numbers in [0.5, 2], absolute; readings allow for 4.8e-7 [octaves, over the numbers]
    }; // What a probe found, before anything ran, by thousands of numbers whose results the processor knows. Methods do not run where it contradicts what their lists rest on. Absent in older results
  }; // The device of the cases whose method runs on one (assigner.on_device). Absent where there are none
  config: {
    allocation: {
      margin: number; // What is allocated / the high-water mark [ratio, over all cases]
      warn_at: number; // Share of the allocation above which to warn [share of 1, over all cases]
    }; // What `recommended` is made with; `clusterbench size` goes by it
    rank_by?: "frame_time" | "frame_cost"; // What rows, ranks and pareto_front go by; absent in older results: frame_time
  }; // The configuration with every default (`clusterbench schema config`)
  scenes: Array<{
    name: string; // Name in the names of cases: the file's, without its extension
    sha256: string; // Hash of the file and of all files that it refers to; of a scene made in memory, of its lights
    lights: {
      point: number; // Point lights
      spot: number; // Spot lights
      directional: number; // Directional lights: they reach everything and are never assigned
      box: number; // Oriented boxes, from extras
      dark?: number; // Of the points and spots those that light nothing: of intensity 0, black, or of range 0, at the beginning, the middle and the end of the animations. Methods get them all the same. Absent in older results
    }; // By type [lights, over the scene]
    light_digest?: string; // The same for the same assigned lights (kinds, positions, ranges, directions, angles, whether they are dark, along their animations, and how many directional ones), whatever their names, order and file are; absent in older results
    frames: number; // Frames of all camera paths together [frames, over the scene]
    range_rule: {
      clamped: number; // Lights whose range was cut to max_range [lights, over the scene]
      cutoff_lux: number | null; // A light without a range ends where its illuminance falls to this [lux, over each light]
      dark?: number; // In older results: what is lights.dark now [lights, over the scene]
      from_intensity: number; // Lights without a range, which got one from their intensity [lights, over the scene]
      given: number; // Lights with a range in the file [lights, over the scene]
      max_range: number | null; // Largest range that such a light gets [m, over each light]
      ranges?: {
        greatest: number; // Longest
        least: number; // Shortest
        median: number; // Middle
      }; // Ranges that were used, of all lights with an end. Absent where no light has one [m, over the scene]
    }; // Where lights' ranges come from
    warnings: string[]; // What is unusual about the scene, as text
    rig?: {
      lights: number; // Number of lights [lights, over the scene]
      range: number; // Range of each light [m, over each light]
      seed: number; // Seed of the random numbers [seed, over the scene]
      size: Vector; // Size of the box, [x, y, z] [m, over the scene]
      spots: number; // Share of spots [share of 1, over the lights]
    }; // Settings of a scene that was made in memory; absent for files
  }>;
  cases: Array<{
    id: string; // Stable over runs and machines: hash of everything that identifies the case
    settings?: string; // The same but for the contents of the scene's file: stable while a level changes
    name: string; // scene/camera/grid/assigner/storage, then the pre-cull where there is one, and the precision where it is not float32
    scene: string; // Name of one of scenes
    camera: string; // Name in the scene, or of the path that was made because the scene has no camera
    camera_path?: {
      from_s: number; // Time of the first frame [s, over the path]
      to_s: number; // Time of the last frame [s, over the path]
      digest?: string; // The same for the same motion and projection, whatever the file is and in however many frames it is measured; absent for a path that was made for a scene without cameras
    }; // Along which the camera is measured; absent in older results
    viewport: [number, number]; // [width, height] [pixels, over the case]
    frames: number; // Frames of the camera's path [frames, over the case]
    grid: {
      aspect?: {
        max: number; // Deepest
        min: number; // Flattest
      }; // Where the configuration asks for cells of a shape: how many times as deep as high cells are at their near side; without the first slice, which holds what lies before it, too [ratio, over the slices]
      bounds?: {
        max: Vector; // Highest corner
        min: Vector; // Lowest corner
      }; // Of world grids: the box, relative to the origin [m, over the grid]
      cell_size?: Vector; // Of world grids: edges of a cell [m, over the grid]
      cells: [number, number, number]; // Number of cells, [x, y, z]; z of cascades counts the cells of all levels [cells, over the grid]
      finest?: number; // Of cascades: edge of a cell of the first level; each further level doubles it [m, over the grid]
      follow?: "camera" | "lights"; // Of world grids that follow something from frame to frame: origin, bounds and cell_size are the last frame's
      kind: "frustum" | "distance" | "cascades" | "world"; // How space is cut: docs/grids-and-lookups.md
      levels?: number; // Of cascades: number of nested boxes [levels, over the grid]
      name: string; // Kind, tiles and slices in words, as in names of cases
      note?: string; // What to know about the slices or the box, as text: where slices end if nothing names a far plane, or that those of the last frame are shown
      origin?: Vector; // Of world grids: position in the world that bounds are relative to [m, over the grid]
      slices?: {
        boundaries: number[]; // Near to far, one more than slices: of depth, of distance grids of the distance from the eye [m, over the grid]
        lookup: {
          bias?: number; // Added after scale [slices, over the grid]
          first?: number; // Depth below which a sample is in slice 0; absent where the formula holds for slice 0, too [m, over the grid]
          form: "linear" | "log2" | "search"; // slice = int(depth * scale + bias), int(log2(depth) * scale + bias), or a search in boundaries
          scale?: number; // Factor of the lookup [slices per m, or per doubling, over the grid]
        }; // A shader's way from depth to slice
        scheme: string; // As the configuration has it
      }; // Of frustum and distance grids
      tiles?: {
        count?: [number, number]; // [columns, rows] of the screen [tiles, over the screen]
        pixels?: [number, number]; // [width, height] of a tile [pixels, over one tile]
      }; // Of frustum and distance grids: count or pixels, as the configuration has it
    }; // The grid, with the constants of a shader's lookup
    assigner: {
      name: string; // As `clusterbench list` has it
      label: string; // Name with the parameters that differ from their defaults
      params: Record<string, unknown>; // All parameters, with their defaults
      conservative: boolean; // Never misses a true pair; a miss fails the run. False on packed lights that are not inflated
      exact: boolean; // Conservative, and lists nothing that is not true
      on_device?: boolean; // true: it runs on the result's device, whose clock times it (device); there is no timing. Absent: it runs on the processor
      file?: string; // Of a method that is not built in: the name of its file
      sha256?: string; // And of all of its files together. No part of the case's id, so that two versions compare
    }; // The method that fills the lists
    storage: string; // What the lists are kept in; own: the assigner leaves a light structure of its own, without lists
    samples_search?: boolean; // true: the case is a light structure that each sample searches for its lights (a hierarchy, masks of bits) in place of reading a list. What that reads is counted and priced by config.cost, and no GPU has measured it: such a case stands on no front. Absent: it is none
    preset?: string; // The preset that the case is of (`clusterbench list presets`); absent for the configuration's own clusterings
    machine?: string; // Name of one of machines, where its times and instructions were measured; absent where they are of one machine, and without any
    failures: Array<{
      kind: "lost_pairs" | "extra_pairs" | "lost_at_samples" | "dropped_pairs" | "wrong_readings" | "crashed" | "timed_out" | "out_of_memory" | "failed"; // Of a conservative or exact method: lost_pairs in lists, lost_at_samples without cells. extra_pairs: of an exact one. dropped_pairs: beyond limits.dropped_pairs of the configuration. wrong_readings: a device walked other lights than the structure has (reading). crashed, timed_out, out_of_memory, failed: of a plug-in, after the case was measured, as in broken
      text: string; // The same for people, without the case's name
    }>; // Why the case fails the run; empty: it passes
    warnings: Array<{
      kind: "dropped_pairs" | "unlit" | "undecided" | "lost_pairs" | "unchecked" | "too_many_lights" | "repeated_lights"; // dropped_pairs: the storage was full. unlit: more than 0.001 of the lights that samples need are not given. undecided: pairs that exact arithmetic left open. lost_pairs: of a method that is not conservative. unchecked: no truth to hold the lists against. too_many_lights: frames have more lights than a limit lets in. repeated_lights: lights are twice in a list
      text: string; // The same for people, without the case's name
    }>; // What to know about the case before believing its figures, beside its failures
    loses_lights: boolean; // Whether a shader lacks lights: pairs that are not listed or were dropped, lights that samples of a structure without cells miss, or more than 0.001 of those that visible surfaces need; without samples of surfaces, of those that random points in the view need
    eligible: boolean; // Whether it may stand on the Pareto front, and be the best that others are measured by: it fails nothing, loses no lights (loses_lights), and its method is conservative, exact or of a preset: others can lose lights in frames that were not measured
    tests_done: number; // Over all frames: cells, rows of cells, lights or planes, whichever a method looks at one by one; a method that looks at many at a time counts otherwise than its scalar reference [tests, over all frames]
    fallbacks: number; // Pairs that the method could not decide in single precision and decided at greater cost [pairs, over all frames]
    lights?: number; // Lights of the scene that methods get: points, spots, and boxes where the configuration asks for them. Absent in older results [lights, over the scene]
    lights_lit?: number; // Those of them that shine in some frame: not of intensity 0, black, or of range 0; boxes count as lit. Dark lights are in lists and all other figures like others. Absent in older results [lights, over all frames]
    lights_seen?: number; // Those of them that are in view (lights_in_view) in a frame in which they shine, each once. Absent in older results [lights, over all frames]
    lights_in_view?: {
      mean: number; // Over the frames [over all frames]
      max: number; // In the frame with most [over the worst frame]
      frames_at_max: number; // How many frames have as many [frames, over all frames]
      worst_frame: number; // The first of them [index, over the path]
      max_by_type: {
        point: number; // Point lights
        spot: number; // Spot lights
        box: number; // Boxes
      }; // Of each type by itself, in the frame that has most of it [over the worst frame]
      shining_mean?: number; // Of those in view the ones that shine in the frame, mean over the frames. Absent in older results [over all frames]
    }; // Lights of a frame whose bounding sphere (a spot's: around its cone) reaches into the half-spaces of the camera's six planes, before any pre-cull; the same for all cases of a camera and viewport. What engines' limits of lights are about. Absent in older results [lights]
    lights_beyond_grid?: {
      max: number; // In the frame with most; 0: none ever does [over the worst frame]
      frames: number; // How many frames have such a light [frames, over all frames]
    }; // Lights in view that may reach a point in view which lies in no cell of the grid. 0: samples beyond the cells lack nothing, however few they are. Absent without cells of the grid and in older results [lights]
    occupancy?: {
      pairs: Spread; // (cell, light) pairs of a frame [pairs, over all frames]
      lights_per_cell: {
        mean: number | null; // Arithmetic mean
        p50: number | null; // Median
        p95: number | null; // 95th percentile
        p99: number | null; // 99th percentile
        max: number | null; // Largest
        histogram: {
          lights_per_entry: number; // More than 1 where lists are longer than 255: an entry counts cells with this many lengths [lights, over the case]
          cells: number[]; // [n]: cells with n * lights_per_entry lights, up to those of the next entry [cells]
        }; // Cells by the length of their lists
      }; // Lights in a cell's list; percentiles are nearest-rank [lights, over all cells of all frames]
      occupied_fraction: Spread; // Share of the cells with a light [share of 1, over all frames]
      worst_frame: number; // Frame with the longest list [frame, over the path]
      worst_cell: Cell; // Cell with the longest list
      along_path: {
        frames_per_entry: number; // More than 1 on paths of more than 512 frames: an entry is the largest of so many [frames, over the case]
        pairs: number[]; // Pairs (cell, light) of each frame [pairs]
        longest_list: number[]; // In the fullest cell of the frame [lights]
      }; // Frame by frame [over each frame]
      longest_by_slice?: number[]; // [z]: in the fullest cell of that slice, in cascades of that layer of cells of a level; absent in world grids, where slices move along the path, and for methods with cells of their own [lights, over all frames]
    }; // How full the grid's cells are; absent without cells
    buffers: {
      index_entries: HighWater; // Entries of all lists [entries, over all frames]
      bytes: HighWater; // Headers and indices [bytes, over all frames]
      index_bits: number; // Of an entry: a light index, a word of a bitfield or of tile masks, a node of linked lists or of a hierarchy [bits, over one entry]
      header_bytes: number; // Of bytes, those whose number does not depend on the lights: offsets and counts of the cells [bytes, over one frame]
      upload_bytes: {
        mean: number | null; // Mean per frame
        max: number; // Of the frame with most
      }; // What a frame would send to a GPU [bytes, over all frames]
      used_share: MeanMax; // Entries that a frame uses, of index_entries.recommended [share of 1, over all frames]
      overflow: {
        dropped_pairs: number; // That the storage had no room for [pairs, over all frames]
        cells: number; // In which pairs were dropped, counted in each frame [cells, over all frames]
        frames: number; // In which pairs were dropped [frames, over all frames]
        lights: number[]; // Indices of those that were dropped anywhere [light index, over all frames]
      }; // What a full storage loses
      repeated_pairs?: number; // Of a user's shader: a light in a list where it is already, and would be added again; absent: none [pairs, over all frames]
      scratch_bytes: number; // The assigner's own memory, the most it held [bytes, over all frames]
      worst_frame: number; // That made the high-water mark [frame, over the path]
      traffic_bytes?: {
        mean: number | null; // Mean per frame
        max: number; // Of the frame with most
      }; // What a GPU reads and writes for lights that are drawn over pixels; absent where none are [bytes, over all frames]
      worst_cell?: Cell; // That has this frame's longest list; absent without cells
      along_path: {
        frames_per_entry: number; // More than 1 on paths of more than 512 frames: an entry is the largest of so many [frames, over the case]
        bytes: number[]; // Headers and indices of the frame [bytes]
      }; // Frame by frame [over each frame]
      each?: Array<{
        name: string; // indices, headers, header_blocks (packed), counts (fixed), words (bitfield), nodes, heads (linked), masks, bins, order (z-binning), boxes (bvh), growths (tile-slices); other methods' have names of their own
        element_bytes: number; // Size of an element [bytes, over one element]
        step: number; // Elements come in multiples of it [elements, over the worst frame]
        high_water: number; // That the worst frame needs [elements, over all frames]
        theoretical_max: number; // That any frame could need with this grid and these lights [elements, over all frames]
        worst_frame: number; // That made the high-water mark, the first one [frame, over the path]
        worst_cell?: Cell; // That has this frame's longest list; absent without cells
        along_path?: {
          frames_per_entry: number; // More than 1 on paths of more than 512 frames: an entry is the largest of so many [frames, over the case]
          elements: number[]; // That the frame needs [elements]
        }; // Frame by frame; absent where every frame needs high_water [over each frame]
      }>; // Each buffer of the structure as an engine allocates it: what it needs so that nothing is dropped
    }; // What to allocate
    cells_not_compared?: number; // Cells of a frame's grid that were not compared with the truth, since there are too many (config.accuracy.most_pairs): there is no error, a structure of its own has no occupancy, and what samples lack decides. Absent: they were compared, or it was not asked for [count, over one frame]
    error?: {
      true_pairs: number; // (cell, light) pairs that touch, decided exactly [pairs]
      reported_pairs: number; // In the method's lists [pairs]
      false_positives: number; // Pairs that are listed and not true [pairs]
      false_negatives: number; // True pairs that are not listed [pairs]
      excess_ratio: number | null; // false_positives / true_pairs [share of 1]
      miss_ratio: number | null; // false_negatives / true_pairs [share of 1]
      deepest_miss: number | null; // Largest 1 - d/r: the cell's distance from the light d, its range r. 0 without misses [share of the light's range, over the misses]
      undecided: number; // Pairs for which neither a common point nor a separation could be proven; counted as true [pairs]
      frames_checked: number; // Whose lists were held against the truth [frames]
      decided: {
        filter: number; // By double precision
        exact: number; // Decided or proven in exact arithmetic
      }; // How the truth was found [pairs]
      deepest?: {
        frame: number; // Number of the frame on the camera's path, from 0 [frame, over one miss]
        cell: Cell;
        light: number; // Index in the lists [light index, over one miss]
        rig_light: number; // Its place among all lights of the scene [light index, over one miss]
        light_name: string; // In the scene
      }; // The deepest miss; absent without misses
    }; // Lists against the truth; absent without cells, where it is not asked for, and with cells_not_compared [over all frames]
    shading?: SampleSet; // What a shader would loop over at points in the whole view, at random pixels and depths [over the samples of all frames]
    samples?: {
      opaque?: SampleSet;
      transparent?: SampleSet;
      fog?: SampleSet;
      mirror?: SampleSet;
      anywhere?: SampleSet;
    }; // What a shader would loop over at sets of points that the configuration asks for, by the set's name; without sets that the scene has not [over the set's samples of all frames]
    depth_ranges?: {
      slopes: DepthLengths; // In tiles where 1 / depth (orthographic: depth) changes from each pixel to the next by at most a quarter of what it changes by in the tile
      discontinuities: DepthLengths; // In the other tiles
      outside: number; // Visible pixels beside the grid, in none of the tiles [pixels]
    }; // How much depth the list of a visible pixel covers, by the kind of list, whatever the case's method is; with samples.opaque on a frustum grid [over the visible pixels of all frames]
    lookup?: Array<{
      logarithm: "rounded" | "glsl" | "fast"; // How the lookup took its logarithm; glsl: at either end of what is allowed
      depth: "given" | "d32f" | "d24"; // Where its depth came from
      samples: number; // Over all frames [samples]
      needed: number; // Lights that reach the samples [lights]
      missed: number; // Of those, not in what the lookup found [lights]
      wrong_samples: number; // Samples that miss a light [samples]
      safe_padding_ulps: number; // By so many ulps slices must reach over their boundaries to hold every depth that is looked up in them [ulps]
    }>; // A shader's lookup on samples, once per logarithm and depth [over the samples of all frames]
    stability?: {
      steps: number; // Steps taken: fewer than asked for where the path ends or the camera stands still [steps, over the piece of the path]
      step_m: number | null; // Largest move of the camera in one step [m, over the steps]
      step_deg: number | null; // Largest turn of the camera in one step, in degrees [degrees, over the steps]
      window: number; // Steps within which a change back is a flicker [steps, over the case]
      from_frame: number; // Frame of the path where the steps begin [frame, over the path]
      drift: boolean; // The camera stands still and was moved artificially, as path says
      path: string; // Where the steps come from
      grids: number; // Grids made along the steps; with more than one, cells themselves move [grids, over the steps]
      changed: {
        method: Churn; // In the method's lists
        truth: Churn; // In the true lists
      }; // Pairs (cell, light) added or removed from one step to the next
      flickers: {
        method: number; // In the method's lists
        truth: number; // In the true lists
      }; // Changes that undo the same pair's change at most `window` steps before, over all steps [changes, over the steps]
      excess_churn: {
        pairs: number; // Below 0 where the truth has more [pairs]
        ratio: number | null; // Divided by those of the truth; null where the truth has none [ratio]
      }; // Changes of the method less those of the truth [over the steps]
      excess_flickers: {
        count: number; // Below 0 where the truth has more [changes]
        ratio: number | null; // Divided by those of the truth; null where the truth has none [ratio]
      }; // Flickers of the method less those of the truth [over the steps]
      undecided: number; // Pairs of the truth that exact arithmetic left undecided, over all steps; counted as true [pairs, over the steps]
    }; // Lists along a piece of the path in fine steps, beside the true lists; where the configuration asks for it
    precision?: {
      packing: "float32" | "half" | "unorm16"; // How lights are packed before the assigner sees them
      inflate: boolean; // Each light is grown by what packing can have lost. Without it a packed case's assigner is not conservative, and misses do not fail the run
      label: string; // The packing's name, with +inflate if lights are inflated
      position_error_m: MeanMax; // Distance of the unpacked position from the scene's own [m, over the lights of all frames]
      range_error_m: MeanMax; // By how much ranges are too long: they are rounded up [m, over the lights of all frames]
      axis_error_rad: MeanMax; // Error of spots' axes; null where there is no spot [rad, over the spots of all frames]
      angle_error_rad: MeanMax; // Error of spots' half-angles; null where there is no spot [rad, over the spots of all frames]
      safe_inflation_m: MeanMax; // How far a packed volume can be from the exact one, from the unpacked numbers alone: bound of the place, and for spots the bounds of axis and angle times the range. Growing by it is enough [m, over the lights of all frames]
      unrepresentable: {
        lights: number; // Most such lights in one frame [lights, over all frames]
        frames: number; // Frames with at least one such light [frames, over all frames]
      }; // Lights that the format cannot hold: without end; in half a coordinate or range beyond 65504 m. They stay in float32 here; an engine's conversion makes them infinite or cuts them off
      extra_pairs?: {
        mean: number | null; // Mean per frame [pairs, over all frames]
        ratio: number | null; // Extra pairs / pairs in float32 [ratio, over all frames]
      }; // Pairs more than the same case in float32; null where there is no such case
    }; // How precisely the assigner gets its lights; where the configuration asks for more than float32
    pre_cull?: {
      label: string; // The steps in their order: frustum, distance(m), visible-set(view_cell_m,voxel_m,rays), most(lights,which are kept), most(lights,which are kept,type)
      conservative: boolean; // In no frame can it remove a light that shares a point with a cell. Where it can, losses are counted and do not fail the run. frustum: in frustum and distance grids, whose cells end with the picture. distance: where no cell reaches farther. visible-set: never. most: where no frame has more lights
      kept: MeanMax; // Lights that the assigner gets [lights, over all frames]
      removed: MeanMax; // Lights that it does not get, the distant ones among them [lights, over all frames]
      distant: MeanMax; // Lights that a distance step puts into the list of distant lights [lights, over all frames]
      steps: Array<{
        label: string; // The step
        removed: MeanMax; // Lights that it removes of those that the steps before it leave [lights, over all frames]
        frames?: number; // In which it removes lights; absent in older results [frames, over all frames]
      }>; // In their order
      lost_pairs: number; // True pairs of lights that are removed; they are among error.false_negatives. 0 where nothing is held against the truth [pairs, over all frames]
      lost_at_samples: Record<string, {
        needed: number; // Lights that reach the samples [lights, over the samples of all frames]
        lost: number; // Of those, removed [lights, over the samples of all frames]
      }>; // By the set's name (volume: the random samples in the whole view)
      view_cells: number; // View cells that have a visible set; 0 without such a step [view cells, over the path]
      bytes: number; // Of all view cells' sets: a bit per light, and voxels where lights move [bytes, over the path]
      build_ns?: number; // What building the sets took, once and beside all other times; absent where nothing is timed [ns, over one build]
      over_limit?: {
        lights: number[]; // Indices of those that it removes in some frame [light index, over all frames]
        lost_pairs: number; // True pairs of lights in frames where it removes them; they are among lost_pairs [pairs, over all frames]
      }; // What a limit (most) removes; absent without one
    }; // What happens to lights before the assigner gets them; absent where it gets all. buffers, tests_done and times are those of the lights that are left; error, shading and samples are told against all lights, in their indices
    fit?: {
      to: "lights" | "surfaces" | "both" | "ranges"; // What is followed
      damping: number; // Share of a shrinking that is left after one frame [ratio, over the case]
      step: number; // Ends lie at powers of this factor; 1: anywhere [ratio, over the case]
      asked: {
        near: number; // First boundary
        far: number; // Last boundary
      }; // Ends of the slices that do not follow, in the last frame [m, over the case]
      near: Extremes; // Where slices begin, of exponential-first ones where the first one ends; null where no frame needs anything [m, over frames that need something]
      far: Extremes; // Where slices end [m, over frames]
      moves: {
        steps: number; // From a frame to the next [steps, over the path]
        changed: number; // Steps to a grid with other boundaries; a method is then built again [steps, over the path]
        cells: number | null; // Share of the cells that are other ones than in the frame before, mean; null with one frame [share, over the steps]
        boundaries: Extremes; // How far a boundary moves, in thicknesses that the slice before it had [slices, over boundaries of all steps]
      }; // How the grid changes from frame to frame
      fitted: FitSide; // This case
      unfitted: FitSide; // The same case in the grid that does not follow
      saved: Saved; // 1 - fitted / unfitted: below 0 where following costs; null where the unfitted case has none
    }; // Of slices that follow what frames need (slices.fit): what that saves and risks beside the same case in the same grid without
    react?: {
      to: "entries" | "mask-words"; // What tiles react to: entries of lists in the frame before, or words of masks in the frame itself
      most: number; // Entries or words that there is room for [entries, over the case]
      of?: string; // The method whose lists are counted; only of entries
      most_lights?: number; // Lights that get a bit at most; absent without a limit [lights, over the case]
      tiles: {
        asked: [number, number]; // Across and down, where nothing makes them larger [tiles, over the case]
        fewest: [number, number]; // The fewest across and the fewest down [tiles, over frames]
        per_frame: Extremes; // In a frame [tiles, over frames]
      }; // Tiles of the frames
      needed: Extremes; // Entries of the counted method's lists, or words, in a frame's own tiles [entries, over frames]
      frames: {
        reacted: number; // With other tiles than asked for [frames, over the path]
        over: number; // That need more than there is room for in their own tiles [frames, over the path]
      }; // Frames of the path
      moves: {
        steps: number; // From a frame to the next [steps, over the path]
        changed: number; // Steps to other tiles; a method is then built again, and all lists are new [steps, over the path]
      }; // How tiles change from frame to frame
      reacting: FitSide; // This case
      fixed?: FitSide; // The same case in the tiles asked for; absent where these make more than a million cells
      saved?: Saved; // 1 - reacting / fixed: below 0 where reacting costs; null where the other case has none; absent without it
    }; // Of tiles that react (react of a grid): how often they did, and what that saves and costs beside the same case in the tiles that were asked for
    fallback?: {
      frames: number; // With a cell that reads all lights [frames, over the path]
      cells: number; // That read all lights [cells, over all frames]
      limited: FitSide; // This case
      roomy: FitSide; // The same case with room for all lists
      saved: Saved; // 1 - limited / roomy: below 0 where falling back costs; null where the other case has none
    }; // Of a storage whose room can end (packed with max_entries): how often cells read all lights of the frame in place of their own, and what that saves and costs beside the same case with room for all
    shadows?: {
      culls?: Array<{
        resolution: number; // Texels along each side of a light's shadow map [texels, over the case]
        texels: "proven" | "sampled"; // How a texel's distance was found. proven: triangles were shown to cover it; sampled: the greatest at its four corners
        bias_m: number; // So far beyond a surface a point may lie and still be lit [m, over the case]
        near_m: number; // Surfaces nearer to a light cast no shadow [m, over the case]
        conservative: boolean; // true: no pair that is lit is taken out, but through gaps and along edges narrower than a millionth of the distance. false: a map of samples bounds nothing between them; what was lost is counted at samples alone
        pairs: BeforeAfter; // In lists [pairs]
        true_pairs?: BeforeAfter; // Of those, the true ones: cell and volume share a point; absent without accuracy.check [pairs]
        opaque?: {
          samples: number; // Number of samples [samples, over all frames]
          evaluated: BeforeAfter; // Lights in the lists of their cells [lights]
          needed: number; // Of those before, lights whose volume holds the sample [lights]
          lit: number; // Of the needed, those that a ray from the light to the sample finds unobstructed: what the best of all shadow culls would keep [lights]
          wrongly_removed: number; // Of the lit, those that were taken out [lights]
          lost_irradiance: number | null; // Share of the lit lights' irradiance that is lost with them [share of 1]
        }; // At visible surfaces in cells of the grid; with samples.opaque [over the samples of all frames]
        maps: {
          lights: number; // Lights with a map [lights]
          made: number; // Maps that were made [maps]
          faces: number; // Of those [faces]
          texels: number; // Of those, texels into which light goes [texels]
          unlimited: number; // Of those, texels without a distance: a ray meets nothing, or (proven) a gap may be left [texels]
          bytes: number; // One map for each light, with all levels of its pyramid, as 32-bit floats [bytes]
        }; // Shadow maps of the lights in these lists, made when a light is first in one and again when it or a surface has moved [over the path]
      }>; // Pairs whose cell lies wholly in the light's shadow, taken out of the method's lists (not of its own structure, where it leaves one): once for each resolution and kind of texels. All other figures of the case are those of the lists before
      frusta?: {
        apart_m: number; // Largest distance between two lights of a group [m, over the case]
        turned_deg: number; // Largest angle between two axes of a group [degrees, over the case]
        growth: number; // Largest volume of a group's frustum, over that of its largest member's own [ratio, over the case]
        points: MeanMax; // Points whose sphere may be in view; they share nothing [lights]
        spots: MeanMax; // Spots whose bounding sphere may be in view: maps if none is shared [lights]
        maps: MeanMax; // Maps of these spots if they share [maps]
        shared: MeanMax; // Of the maps, those with more than one spot [maps]
        saved: number | null; // Share of the spots' maps that sharing saves, over all frames; null without spots in view [share of 1]
        most_members: number; // Most spots in one map [lights]
        volume: {
          over_largest: MeanMax; // Over that of the largest of its members' own frusta; null without shared ones
          over_sum: MeanMax; // Over the sum of its members' own
        }; // Of a shared frustum [ratio, over shared frusta of all frames]
        solid_angle: {
          over_largest: MeanMax; // Over that of the widest of its members' own frusta; null without shared ones
          over_sum: MeanMax; // Over the sum of its members' own
        }; // Of a shared frustum [ratio, over shared frusta of all frames]
      }; // Shadow maps that spots in view could share, whatever the case's method and grid are: groups of spots in one square frustum that holds them all [over frames]
    }; // What lies in the shadow of the scene's triangles, and what sharing shadow maps saves; where the configuration asks for it (shadow_cull, shadow_frusta)
    timing?: {
      frames_timed: number; // Evenly spaced over the path; all times but that of worst_frame are means over them [frames, over the path]
      caches?: "cold" | "warm"; // Of frame_ns, assign_ns, convert_ns, worst_frame and against_first. cold: swept before each frame, as all else of an engine's frame does; warm: the same frames again and again. Absent in older results: warm
      session?: string; // Equal in cases that the same launches have measured; only their times have ratios
      launches?: number; // Processes that measured, each an equal share of every array of samples, one after the other. From two on all 95 % intervals are between launches (Student's t on the logarithms of the launches' medians), else they are bootstrap intervals over the rounds of one process [processes, over the case]
      frame_ns: Time; // Per frame: what a frame takes, pre_cull_ns, assign_ns and convert_ns of the same round together
      worst_frame?: {
        frame: number; // Number of the frame on the camera's path, from 0 [frame, over the path]
        ns: number | null; // Time of this frame: its share of a pass over the timed frames, by the frames' medians over the rounds, of frame_ns [ns, over the rounds]
        ci95: Interval; // 95 % interval of ns [ns, over the rounds]
        pairs?: number; // Pairs (cell, light) of this frame; absent without cells [pairs, over one frame]
      }; // The slowest of the timed frames and of the path's frame with the most pairs, which is timed beside them
      pairs?: {
        mean: number | null; // Mean per frame
        max: number; // Largest of a frame
      }; // (cell, light) pairs of the timed frames, which frame_ns goes with; absent without cells [pairs, over the timed frames]
      builds_per_frame?: number; // 0: the grid stays from frame to frame; 1: each frame has its own, as with fit slices or a projection that moves [builds, over the timed frames]
      build_ns: Time; // Per build: preparing for a grid, once for each projection
      assign_ns: Time; // Per frame: assignment, mean over the timed frames, with the builds of builds_per_frame
      convert_ns?: Time; // Per frame: from lists to the layout of the storage; absent where a method leaves its own structure
      warm?: {
        frame_ns: Time; // Per frame: pre_cull_ns, assign_ns and convert_ns
        assign_ns: Time; // Per frame: as the one beside cold times
        convert_ns?: Time; // Per frame: as the one beside cold times
        pre_cull_ns?: Time; // Per frame: as the one beside cold times
      }; // The same frames with warm caches, beside cold times; samples need not be as many
      passes_per_sample?: {
        assign: number; // Of assign_ns
        convert?: number; // Of convert_ns; absent where a method leaves its own structure
      }; // How many passes over the timed frames one sample of warm times is the mean of, in the launch with fewest; each launch runs as many as take timing.min_time_ms. A sample of cold times is one pass [passes, over one sample]
      pre_cull_ns?: Time; // Per frame: from all lights to those that the method gets, side by side; absent where nothing is culled. Visible sets are built before (pre_cull.build_ns)
      shadow_cull?: Array<{
        resolution: number; // As in shadows.culls [texels, over the case]
        texels: "proven" | "sampled"; // As in shadows.culls
        bias_m: number; // As in shadows.culls [m, over the case]
        near_m: number; // As in shadows.culls [m, over the case]
        cast_ns: number; // Making the finest level of a map by ray casting, mean; a renderer has its shadow map already [over maps of all methods]
        reduce_ns: number; // Making the coarser levels of a map, mean [over maps of all methods]
        step_ns: MeanMax; // Taking pairs out of a frame's lists, on one thread [over frames]
      }>; // Of the ways of shadows.culls, in their order; in no other time. Wall time in the process of the run, where the lists are checked
      ns_per_pair: number | null; // frame_ns.median / pairs.mean; null without pairs in lists [ns, over the timed frames]
      write_floor_ns: number | null; // Per frame: time to copy its finished lists once as the standard `packed` holds them, headers and indices, from buffers of the frame into others of the frame [ns, over the rounds]
      floor_ratio: number | null; // assign_ns by write_floor_ns, both with warm caches: how far the assignment is from only writing its result [ratio, over the rounds]
      against_first?: {
        assigner: string; // Label of the first assigner
        ratio: number | null; // This case's frame time by that of the group's first assigner in the same storage: median of the rounds' ratios [ratio, over the rounds]
        ci95: Interval; // 95 % interval of the ratio [ratio, over the rounds]
      }; // How much longer than the group's first assigner; absent of that one. A group: scene, camera, viewport and grid
      disturbed?: {
        others_cores: number | null; // Processors that other programs of the machine kept busy meanwhile, in the mean [processors]
        stolen_cores: number | null; // Processors that other guests of the host took meanwhile, in the mean [processors]
        throttled: number; // Times that processors slowed down because of heat; 0 where Linux does not count them [times]
      }; // What else went on while the cases of this grid, camera and viewport were measured, over all launches [over the measuring of the group]
      fit?: {
        follow_ns: Time; // Finding what a frame needs, and making its grid; in no other time. Building a method for the grid is in assign_ns [ns, over the rounds]
        unfitted_ns: Time; // frame_ns of the same case in the grid that does not follow [ns, over the rounds]
        ratio: number | null; // frame_ns by unfitted_ns: median of the rounds' ratios [ratio, over the rounds]
        ci95: Interval; // 95 % interval of the ratio [ratio, over the rounds]
      }; // Of slices that follow what frames need
      baseline?: {
        launches: Array<{
          base_ns: number[]; // Times of the other program [ns, over the rounds of a launch]
          new_ns: number[]; // Times of this program [ns, over the rounds of a launch]
        }>; // One for each start of both programs; times in the order of their rounds
        base_ns: number | null; // Median of the other program's times [ns, over the rounds of all launches]
        new_ns: number | null; // Median of this program's times [ns, over the rounds of all launches]
        ratio: number | null; // New / base: exp of the trimmed mean over launches of ln(lower quartile of new_ns / lower quartile of base_ns) [ratio, over the launches]
        ci95: Interval; // 95 % interval of the ratio [ratio, over the launches]
        lists_differ?: {
          frames: number; // Number of frames whose lists differ [frames, over all frames]
          frame: number; // First frame whose lists differ [frame, over the path]
          cell: Cell; // First cell whose list differs
          light: number; // First light that only one of the two lists has [light index, over one cell]
          in: "base" | "new"; // Whose list has the light
          base_pairs: number; // Pairs of the other program [pairs, over all frames]
          new_pairs: number; // Pairs of this program [pairs, over all frames]
        }; // Where both programs' lists first differ
      }; // Rounds beside another program (run --baseline-binary)
    }; // Wall times
    device?: {
      device: string; // Name and driver of the device; times of one device alone compare
      software?: boolean; // true: the device computes on the processor: its times are no GPU's, and nothing ranks by them. Absent in older results, where device.type says it
      frames_timed: number; // Evenly spaced over the path; all times are means over them [frames, over the path]
      caches?: "cold" | "warm"; // Of all times here but those of warm. cold: memory of the device is filled before each frame's upload, as all else of an engine's frame does; warm: the same frame again and again. Absent in older results, where caches were as the method before left them
      launches?: number; // How often the device was opened anew, each time for an equal share of every array of samples, one after the other, in one process. From two on all 95 % intervals are between them, else between rounds [openings, over the case]
      run_ns: Time; // Per frame: the device's work, from the lights to the lists
      upload_ns: Time; // Per frame: bringing the frame's lights to the device
      readback_ns: Time; // Per frame: bringing the lists back, which a renderer does not do
      dispatches: number | null; // Steps of this work that wait for each other, per frame [steps, over the timed frames]
      floor_ns: Time; // Per frame: as many steps that do nothing, of which the last writes as many bytes as the result has
      floor_ratio: number | null; // run_ns by floor_ns: how far the work is from only starting and writing [ratio, over the rounds]
      repeats?: DeviceRepeats; // How often a frame's work is repeated in one sample, which is the mean: until it lasts 1,000 periods of the clock and 20 us, if that fits in a submission of 100 ms; in the frame with fewest. Of cold times each has a span of its own. Readbacks are never repeated [repetitions, over one sample of a frame]
      warm?: {
        run_ns: Time; // Per frame: as the one beside cold times
        upload_ns: Time; // Per frame: as the one beside cold times
        floor_ns: Time; // Per frame: as the one beside cold times
        floor_ratio: number | null; // As the one beside cold times [ratio, over the rounds]
        repeats: DeviceRepeats; // As the ones beside cold times [repetitions, over one sample of a frame]
      }; // The same frames with warm caches, beside cold times
      build_ns?: Time; // Per build: the device's work for a changed grid; in no other time. Absent where the host makes the cells
      builds_per_frame?: number; // As in timing, of build_ns [builds, over the timed frames]
      clock_mhz?: {
        median: number | null; // Over the rounds
        min: number | null; // In the slowest round
        max: number | null; // In the fastest round
        samples: Array<number | null>; // Of each round, launch after launch
      }; // How fast the device ran, by a shader that counts cycles after each round of the method. Absent where its shaders cannot count. Some devices count at a fixed rate [MHz, over the rounds]
      shaders?: Array<{
        shader: string; // Of src/gpu/shaders, with its mode if it has one
        name: string; // As the driver calls it
        value: number; // As the driver tells it [the driver's, over one shader]
      }>; // Registers, spills and memory of the method's shaders. Absent where the driver tells nothing
    }; // Times of a method that runs on a device (a GPU), by the device's own clock. Absent elsewhere, and where nothing is timed or the device has no clock
    reading?: {
      device: string; // Name and driver of the device; times of one device alone compare
      software: boolean; // true: the device computes on the processor: its times are no GPU's, and nothing ranks by them
      frames: number; // Evenly spaced over the path; all times are means over them [frames, over the path]
      structure_bytes: number | null; // Of the light structure, mean [B, over the frames that are read]
      exact?: {
        storage: string; // In which they are kept
        bytes: number | null; // Of this structure, mean [B, over the frames that are read]
      }; // The lists of exact_ns: the case's storage filled with exact lists of all lights; `packed` beside a structure of a method's own. Absent where cells are not compared with the truth
      frame_ns?: number | null; // (1 - config.reading.async) x assignment + upload + reading (the one of set and walk), each a median over its own frames: reading.frames, timing.frames, and all for uploads of the processor. A method on the device: device.run_ns + device.upload_ns; another: timing.frame_ns and buffers.upload_bytes by cost.upload_gb_per_s, and only where config.reading.async is given. Absent where a part of the pixels is read (config.reading.divisor), and where the host has put lists of the device into another storage. Assignments are cold where timing.cold asks for it, readings warm. Builds for a changed grid and the picture of depths are in none [ns, over one frame]
      set: string; // Its samples are those of the figures and of frame_ns: the configuration's first
      walk: string; // Likewise; a structure without cells cannot be walked cell by cell, and then has no figures
      sets: Array<{
        set: "volume" | "opaque" | "transparent" | "fog" | "mirror" | "anywhere"; // Whose samples read, as in samples (volume: random points in the whole view)
        samples: number; // Samples per frame, mean [samples, over the frames that are read]
        lights: number; // Lights that a sample walks, mean [lights, over the samples]
        exact_lights?: number | null; // Lights that a sample walks in the exact lists, mean; absent without them [lights, over the samples]
        reads: number; // Elements of the light structure that a sample fetches, mean [elements, over the samples]
        read_bytes: number; // Their bytes, mean [B, over the samples]
        divergence: number; // Of as many invocations as the device's waves have: the sum of their longest lists by that of their mean ones, weighted by lights over the frames. Idle lanes and steps that walk no light are left out [ratio, over the waves]
        differing: number; // Walks of samples, here and in the exact lists, that met other lights than the structure has, and samples whose cell the device finds farther off than rounding explains. Other than 0: a fault of the driver or of this program, and the times are not to be trusted [walks and samples, over the frames that are read]
        write_ns: Time; // Per frame: each sample writes a word, and reads nothing at all
        nothing_ns: Time; // Per frame: each sample looks up its cell and writes a word made of it, and reads no list. Where samples look up no cell (a hierarchy) it is that of its position
        walks: Array<{
          walk: "lane" | "light" | "cell"; // How the samples of a wave walk their lights. lane: each its own list, until the longest is done. light: all together, light by light. cell: all together, cell by cell
          read_ns: Time; // Per frame: each sample looks up its list, walks its lights, adds a small attenuation for each and writes the sum; the same samples again and again, so that caches hold what fits
          cold_ns: Time; // Per frame: the same once, after other memory went through the caches
          exact_ns?: Time; // Per frame: read_ns of the lists that `exact` names. Absent where cells are not compared with the truth
          exact_ratio?: number | null; // read_ns by exact_ns: median of the rounds' ratios [ratio, over the rounds]
          exact_ci95?: Interval; // 95 % interval of exact_ratio [ratio, over the rounds]
          nothing_ratio: number | null; // read_ns by nothing_ns: median of the rounds' ratios [ratio, over the rounds]
        }>; // In the order of the configuration
      }>; // In the order of the configuration, those that the scene has
    }; // What samples pay for their lights on a device (a GPU), by its clock; where the configuration asks for it (reading). Absent for structures that shaders do not read, and where the device has no clock
    unread?: string; // Why there is no reading though the configuration asks for it, as text
    details?: {
      max_bytes: number; // Most bytes that the configuration allows [bytes, over the case]
      frames: Array<{
        frame: number; // Number of the frame on the camera's path, from 0 [frame, over the path]
        time_s: number; // Time of the animation [s, over the frame]
        camera: {
          eye: Vector; // Position in world space [m, over the frame]
          view_from_world: [Vector, Vector, Vector]; // Rows of the rotation: view = rotation (world - eye), looking down -z [1, over the frame]
          orthographic: boolean; // true: orthographic; false: perspective
          sides: [number, number, number, number]; // Left, right, bottom, top of the image: slopes, or metres of an orthographic camera [slope, or m, over the frame]
          near_m: number; // Near plane [m, over the frame]
          far_m: number | null; // Far plane; null: infinite [m, over the frame]
        }; // Pose and projection
        boundaries?: string; // Boundaries of the slices, as a row of numbers; absent where they are those of the case's grid
        tiles?: {
          count: [number, number]; // Across and down [tiles]
          pixels?: [number, number]; // Width and height of a tile; absent for tiles per screen [px]
        }; // Tiles of a grid that reacts; absent where they are those of the case's grid [over the frame]
        box?: {
          origin: Vector; // Position in the world that min and max are relative to
          min: Vector; // Lowest corner
          max: Vector; // Highest corner
        }; // Box of a world grid; absent where it is that of the case's grid [m, over the frame]
        cells: {
          count: number; // Cells with a reported or a true light; all others are empty [cells, over the frame]
          indices: string; // Gaps of their indices, x fastest, then y, then z
          reported: string; // Lights in each cell's list
          true: string; // Lights that reach each cell
          false_positives: string; // Lights in each cell's list that do not reach it
          false_negatives: string; // Lights that reach each cell and are not in its list
        }; // Rows of count numbers each. A row of numbers is a text: numbers are separated by one space, N*K is N repeated K times. Gaps: the first number, then the difference of each to the one before. docs/details.md has a reader
        lights: {
          indices: string; // Gaps of their indices in the lists
          names: string[]; // Names in the scene, in the order of indices
          positions: string; // 3 numbers per light: x y z in view space, metres
          ranges: string; // Ranges in metres; Infinity: without end
          spots: number; // Number of spots: they are the last ones, or those before the boxes [lights, over the frame]
          spot_axes: string; // 3 numbers per spot: unit vector in view space
          spot_half_angles: string; // Half-angle of each spot's cone, radians
          boxes?: number; // Number of boxes: they are the last ones. Absent without any [boxes, over the frame]
          box_half_axes?: string; // 9 numbers per box: three half axes in view space, metres. Absent without any
        }; // Lights in any list of the frame, reported or true, ascending by index; as rows of numbers
        pairs?: {
          lights: string; // Cell after cell (reported + false_negatives each) the gaps of its lights' indices, which start again in each cell
          marks: string; // 0: reported and true, 1: false positive, 2: false negative
        }; // Each cell's lights; missing where lists are not asked for or left out
      }>;
      left_out: {
        frames: number[]; // Frames for which max_bytes has no room [frame, over the path]
        pairs: number[]; // Frames that are here without their pairs, for which max_bytes has no room [frame, over the path]
        not_on_path: number[]; // Frames that the configuration names and the path does not have [frame, over the path]
      }; // What was asked for and is not in the result
    }; // Chosen frames cell by cell
    count?: {
      source: "perf" | "callgrind"; // Hardware counters or valgrind's callgrind; compare counts of one source only
      simd_target: string; // Instruction set of the counted code; callgrind offers fewer than the machine has
      frames: number; // Frames that are counted: those that are timed [frames, over the path]
      instructions_per_build: number; // Preparation for a grid; as it may take memory, some tens of instructions depend on the heap [instructions, over one build]
      instructions_per_frame: PerFrame; // Instructions of one frame [instructions]
      cycles_per_frame?: PerFrame; // Cycles of one frame; absent where only instructions are counted [cycles]
    }; // Instructions of what is timed, with --count
    cost?: {
      frame_ns: number | null; // assign_ns + gpu_ns; null where nothing is timed, and of presets whose engine makes its lists on a GPU, which is not timed here [ns]
      assign_ns: number | null; // timing.frame_ns.median: assignment and conversion [ns]
      gpu_ns: number | null; // upload_ns + traffic_ns + read_ns + shade_ns: all but the assignment, and the same on every machine [ns]
      upload_ns: number | null; // buffers.upload_bytes.mean / upload_gb_per_s; 0 of presets whose engine makes its lists on a GPU (in older results as of others) [ns]
      traffic_ns: number | null; // buffers.traffic_bytes.mean / memory_gb_per_s [ns]
      read_ns?: number | null; // Sum over the sets: samples x divergence x (reads x ns_per_read + read_bytes / read_gb_per_s). Absent in older results, where reading was free [ns]
      shade_ns: number | null; // Sum over the sets: samples x lights x divergence x ns_per_light [ns]
      lights?: number | null; // Looped over at a sample of these sets, mean [lights]
      overshade?: number | null; // Lights given at the samples of these sets / lights that reach them: the overshade that a rank by cost rests on. null where fewer than 100 reach them, or where one of the sets lacks more than 0.001 of them [ratio]
      sets: Record<string, {
        samples: number | null; // That a frame shades: weight x samples, each of which stands for its block of pixels [samples]
        lights: number | null; // Looped over at one of them, mean [lights]
        divergence: number | null; // Of waves of config.cost.wave pixels; 1 where it is not known, and where lights are drawn [ratio]
        reads?: number | null; // Elements of the light structure (headers, indices, words of bits, nodes) that one of them fetches to know its lights, mean; 0 where lights are drawn [elements]
        read_bytes?: number | null; // Their bytes, mean [B]
        ns: number | null; // samples x divergence x (lights x ns_per_light + reads x ns_per_read + read_bytes / read_gb_per_s) [ns]
      }>; // By name, those that are asked for, have a weight and are there
      lit: boolean; // None of these sets lacks more than 0.001 of the lights that it needs. A case that does is on no front over cost
    }; // What a frame costs with its shading, by the model and the constants of config.cost; where samples of a set with a weight are asked for [over one frame, mean over all frames]
  }>; // One method on one grid in one storage, along one camera's path
  pareto_front: Array<{
    scene: string; // Name of one of scenes
    ids: string[]; // Ids of the cases with a star, in the order of cases
  }>; // Per scene the cases on the Pareto front: no other one of the same camera and viewport is as good in frame time (beyond the interval of their ratio), bytes and overshade together, and better in one; where config.rank_by is frame_cost, in cost and bytes. What draws lights has no lists, so its bytes count as unknown. Only cases that are eligible, and none that samples search
  skipped: Array<{
    name: string; // As of a case, as far as all of the skipped combinations share it
    reason: string; // Why, as text
    preset?: string; // That it is of; absent for the configuration's own clusterings
  }>; // Combinations that cannot be
  broken?: Array<{
    id: string; // As of a case
    settings: string; // As of a case
    name: string; // As of a case
    scene: string; // Name of one of scenes
    camera: string; // As of a case
    preset?: string; // As of a case; absent for the configuration's own clusterings
    method: string; // Name of the assigner
    plugin?: string; // The plug-in that the method is of; absent for one of --shader
    kind: "crashed" | "timed_out" | "out_of_memory" | "failed"; // crashed: its process ended, by a signal or since the plug-in ended it. timed_out: a call did not return within --plugin-timeout. out_of_memory: the process took more than --plugin-memory. failed: the plug-in said so, or what it or a shader left cannot be light lists
    reason: string; // The same for people, without the case's name
    step: "load" | "create" | "build" | "assign" | "query" | "destroy" | "unload"; // The call in which, or after which, it happened. unload: as the process ended
    frame?: number; // Of the camera's path; absent where the call is of none [index, over the path]
    pass?: string; // The work that the call was part of, as text; absent where it is unknown
    signal?: string; // That ended the process, as SIGSEGV; absent where none did
  }>; // Cases of plug-ins that were not measured to the end: the plug-in crashed, hung, took too much memory or failed. Each fails the run. Absent where there are none
  presets?: Array<{
    name: string; // As a case's preset
    engine: string; // Whose scheme it is
    version?: string; // Of its code or publication: a release, a commit, a year; absent in older results
    evidence?: "ran" | "read" | "memory"; // ran: the engine's own code, or a transcription of it, was run and its lists compared. read: its code or publication was read. memory: neither. Absent in older results
    summary: string; // The scheme in a line
    source: string; // What was read
    approximated: string; // What is not as there; empty where nothing is known to differ
    unverified: string; // What stands on memory alone; empty where all was read
    assigns_on?: "cpu" | "gpu"; // Where the engine makes its lists: those of a GPU are not uploaded
    most_lights?: number; // That it takes in a frame; absent where no such limit is known [count, over one frame]
    mistakes?: string; // That the engine has as it is shipped, which config.as_shipped models; absent where none is modelled
  }>; // What is known of the presets that cases are of, as `clusterbench list presets` tells it; absent without any
  preset_rankings?: Array<{
    scene: string; // Name of one of scenes
    camera: string; // As the cases'
    viewport: [number, number]; // As the cases': width, height [pixels, over the cases]
    frames?: number; // Of each case; absent in older results [count, over each case]
    best: string | null; // Id of the case with lists that costs the GPU least of those whose samples lack at most 0.1 % of the lights that they need; null where there is none
    alike?: string[]; // Ids of best and of the cases that the model cannot tell from it; absent in older results
    cases: Array<{
      id: string; // Of the case
      preset: string; // Of the case
      standing?: "lists" | "searched" | "lacks_lights" | "unknown"; // lists: samples lack at most a thousandth of the lights that they need. searched: likewise, and samples search the structure, whose price no GPU has measured. lacks_lights: samples lack more. unknown: no sample needs a light, or samples need fewer than 1000, too few to say so, and pairs are lost or were not compared with the truth. Absent in older results
      place?: number | null; // Among the cases of the same standing, from 1; 1 + how many of them are known to cost less: by more than 5 %, and as each price of config.cost is half or twice what it is. null: not ranked. Absent in older results [count, over the cases]
      gpu_ns: number | null; // upload_ns + traffic_ns + read_ns + shade_ns; null without samples. In older results the case's cost.gpu_ns [ns, over one frame]
      upload_ns?: number | null; // Of the lists, by config.cost: 0 where the engine makes them on a GPU. Absent in older results [ns, over one frame]
      read_ns?: number | null; // What samples read to know their lights, by config.cost. Absent in older results [ns, over one frame]
      shade_ns?: number | null; // Lights that samples loop over, by config.cost; where the scene has no surfaces, each pixel shaded once at a random depth. Absent in older results [ns, over one frame]
      lights_per_sample: number | null; // Lights given at a sample of these sets, mean [count, over all samples]
      unlit?: number | null; // Share of the lights that its samples need and lack: of the sets that cost something the one that lacks most, else on visible surfaces if they are asked for, else in the whole view; null where no sample needs a light. Absent in older results [ratio, over the lights that samples need]
      missed_in_view?: number | null; // Pairs that the lists lack, without those of lights beside the view; null where lists were not compared with the truth. Absent in older results [pairs, over all frames]
      why: string; // What speaks for and against it here, as text
    }>; // Best first: by standing, then by gpu_ns, or by the share of lights that samples lack
    text?: string; // What to take, against what, by how much, and how sure that is, as text; absent in older results
    lights_in_view?: {
      mean: number | null; // Mean
      max: number | null; // Of the frame with most
    }; // As the cases'; absent in older results [lights, over the frames]
  }>; // Per scene, camera and viewport the cases of presets beside each other; absent without any
  conclusions?: Array<{
    scene: string; // Name of one of scenes
    camera: string; // As in cases
    viewport: [number, number]; // [width, height] [px, over the cases]
    machine?: string; // As the cases'; absent where times are of one machine
    take: string | null; // Id of the case to take; null: no case is sound, nothing that they are ranked by sees a light, or the run failed (text says what)
    against: string | null; // Id of the cheapest case that is known to cost more; null: there is none
    ratio: number | null; // Cost of that / cost of the case to take [ratio, over the frame times]
    ci95: [number | null, number | null] | null; // Its 95 % interval, of the times in it; null where times were not measured side by side [ratio, over the frame times]
    alike: string[]; // Ids of cases that are not known to cost more
    by_prices?: [number | null, number | null]; // From and to what ratio goes as each price of config.cost (of uploading, drawing, reading, looping) takes values between half and twice its own; absent where nothing is modelled, and in older results [ratio, over the samples]
    text: string; // The same for people
  }>; // Per scene, camera and viewport what to take by this result, and how sure that is. Of the cases that lose nothing that their samples see, that which costs least: frame time and, where samples were asked for, upload, reading and shading by the model of config.cost. Of those that the times cannot tell apart, or the model (within 5 %), one whose samples lack nothing comes before others, then one on the front, then the one with the fewest bytes. Presets are ranked by themselves. Absent in older results
  failed?: string[]; // What the run failed for beside the failures of its cases, a line each: budgets (limits.fail_if), lights that are missing, what a baseline has, a program beside it. conclusions then take nothing. Absent where it failed for none of these
  baseline?: {
    tool: Tool; // As `tool` of this result's own program
    is_same_program?: boolean; // true: it is this program's own file, byte for byte; else absent
  }; // The other program of run --baseline-binary
};

// A result
export type PageResult = {
  file: string; // Its name for readers
  result: Result; // Itself
  cases: PageCase[]; // One for each case of the result, in its order
  doubts: string[]; // Reasons to doubt its times
  ratios: Ranked[]; // Of timed cases
  costs: FrameCost[]; // Of cases that lose nothing, where the configuration has a model
};

// Numbers of a case
export type PageCase = {
  figures: Record<string, number>; // By their names in the table, without those that the case has not
  sets: string[]; // Sets of samples that rank the case: figures of samples are of them
};

// A timed case with lists, among all of its scene, camera and viewport
export type Ranked = {
  id: string; // Of the case
  fastest: {
    id: string; // Of the other case
    ratio: number | null; // Median [ratio]
    ci95: [number | null, number | null]; // 95 % interval; null: unknown
  } | null; // Beside the fastest; null: it is the fastest, or they have no ratio
  above: {
    id: string; // Of the other case
    ratio: number | null; // Median [ratio]
    ci95: [number | null, number | null]; // 95 % interval; null: unknown
  } | null; // Beside the next faster one
  is_like_above: boolean; // It may be as fast as the next faster one, as far as their ratio is known
};

// Cost of a case that loses nothing, by which conclusions choose
export type FrameCost = {
  id: string; // Of the case
  ns: number; // Making its lists (where timed), upload, reading and shading by config.cost [ns]
  gpu_ns: number; // The modelled part [ns]
};

// A row of the table of figures (`clusterbench list figures`)
export type FigureWords = {
  name: "frame_us" | "frame_us.max" | "assign_us" | "convert_us" | "frame_cost_us" | "instructions" | "assign_instructions" | "speedup" | "pair_rate" | "bytes" | "excess" | "missed" | "unlit" | "dropped" | "overshade" | "lights" | "lights_lit" | "lights_seen" | "lights_in_view" | "tests_done" | "fallbacks" | "lights_seen.mean" | "lights_in_view.mean" | "pairs.mean" | "pairs" | "lights_per_cell.mean" | "lights_per_cell.p99" | "longest" | "occupied_fraction" | "index_entries" | "entries_recommended" | "bytes_recommended" | "upload_bytes.mean" | "gpu_cost_us" | "traffic_bytes" | "upload_bytes" | "scratch_bytes" | "true_pairs" | "reported_pairs" | "false_positives" | "miss_ratio" | "deepest_miss" | "undecided" | "needed" | "evaluated" | "read_bytes" | "samples_missed" | "samples_missed_outside" | "lost_irradiance" | "changed_pairs" | "flickers" | "extra_pairs" | "build_us" | "pairs_timed" | "builds_per_frame" | "time_per_pair" | "write_floor" | "floor_ratio" | "build_instructions" | "convert_instructions" | "assign_cycles" | "convert_cycles" | "lights_beyond_grid" | "device_us" | "device_upload_us" | "device_readback_us" | "device_floor" | "device_warm_us" | "device_build_us" | "device_clock_mhz" | "reading_us" | "reading_x_exact" | "reading_x_nothing" | "device_frame_us"; // In the table
  unit: string; // Of its values here
  meaning: string; // As the table has it
};

// Pixels of some cases, made by `run --images`
export type Picture = {
  kind: string; // As in --image-kinds
  frame: number | null; // null: along the path
  cases: string[]; // Ids of the cases
  text: string; // For readers who do not see it
  url: string; // Contains the picture (data:)
};

// The data of a page that `clusterbench report` writes.
export type PageData = {
  command: string; // Makes the page again
  results: PageResult[]; // In the order of the command
  figures: FigureWords[]; // All rows of the table of figures
  sample_sets: Record<string, string>; // Words for the sets of samples
  pictures: Picture[]; // Of --images
};

// The data of a page that `clusterbench check` writes.
export type CheckPage = {
  command: string; // That makes the page again
  verdict: string; // As `check --json` has it
  frames: Array<{
    checked: {
      dump: string; // Its file
      name: string; // Of the dump
      engine: string; // Of the dump; empty: it does not say
      points: number; // Point lights [lights]
      spots: number; // Spot lights [lights]
      grid_kind: string; // Of the grid
      cells: Cell; // Numbers of columns, rows and slices
      first_row: "top" | "bottom"; // As grid.first_row of the dump, whose rows `row` counts; `cell` always counts from the top
      first_slice: "near" | "far"; // As grid.first_slice, in the same way; `cell` always counts from the near end
      sets: Array<{
        name: string; // Of the set
        verdict: "unreadable" | "misread" | "lost" | "twice" | "empty" | "rounding" | "right"; // unreadable: no lists; misread: other_reading fits far better; lost: a light is missing where it shines, beyond rounding; twice: none is, and one is twice in a list; empty: no light reaches a cell, so nothing was checked; rounding: one is missing within rounding; right: nothing of all that
        reading: {
          fault_count: number; // Values that cannot be right
          faults: Array<{
            buffer: string; // Where it is; empty: in the dump itself
            byte: number; // First byte of the value, in the buffer's file [bytes]
            value: number; // What was read there
            cell: Cell; // Whose list was read: column from the left, row from the top, slice from the near end
            message: string; // What is wrong, in a sentence
          }>; // The first of them
          twice_count: number; // Entries of a light that its list has already [pairs]
          twice: Array<{
            buffer: string; // Where it is; empty: in the dump itself
            byte: number; // First byte of the value, in the buffer's file [bytes]
            value: number; // What was read there
            cell: Cell; // Whose list was read: column from the left, row from the top, slice from the near end
            message: string; // What is wrong, in a sentence
          }>; // The first of them, each at the later entry
          likely_reading: string | null; // Another description under which nothing is wrong; null: none was found
        }; // The buffers
        remarks: string[]; // What may be wrong with the description, though no other reading is likelier: rows of buffers that are not read, cameras and ranges that make many more listed pairs true
        bytes: number; // Of all buffers that its lists are read from [bytes]
        longest_list: number; // Most lights in a cell [lights]
        longest_cell: [number, number, number] | null; // The first cell with so many; null: all are empty
        error: {
          true_pairs: number; // Pairs of a cell and a light that share a point [pairs]
          listed_pairs: number; // Pairs in the lists [pairs]
          false_positives: number; // Listed pairs that are not true [pairs]
          lost_pairs: number; // True pairs that are not listed [pairs]
          lost_within_rounding: number; // Of these, those that `rounding` of the dump allows for [pairs]
          lost_lights: number; // Lights that a cell has lost, each once [lights]
          lost_in_full_lists: number; // Of the lost pairs, those of cells whose list is full (layout fixed) [pairs]
          lost_in_longest_lists: number; // Of the lost pairs, those of cells whose list is as long as the longest [pairs]
          absent_lights: number; // Lights that reach a cell and are in no list at all [lights]
          undecided: number; // Pairs that exact arithmetic could not decide; counted as true [pairs]
          deepest_mm: number | null; // How far the most deeply lost light, by its share of the range, reaches into its cell; of equal shares the longest; null: the range has no end [mm]
          deepest_percent: number; // The same in percent of the range [percent]
        } | null; // Against the exact lists; null where lists could not be read
        lost: Array<{
          light: number; // By its index in the dump
          cell: Cell; // Column from the left, row from the top, slice from the near end
          row: number; // Number of the cell in the dump's own order
          from_m: number; // Where the cell begins: depth, distance, or z in a world grid [m]
          to_m: number; // Where it ends [m]
          reach_mm: number | null; // How far the light reaches into the cell; null: its range has no end [mm]
          reach_percent: number; // The same in percent of the range [percent]
          is_within_rounding: boolean; // Whether `rounding` of the dump allows for it
        }>; // The most deeply lost first, at most 1000
        other_reading: {
          axes: string; // As grid.axes of the dump
          first_row: string; // As grid.first_row
          first_slice: string; // As grid.first_slice
          order: string; // What differs in these three; empty: nothing
          camera: string; // What differs in the camera; empty: nothing
          lists: string; // What differs in the description of the lists; empty: nothing
          lights: string; // What differs in the lights' ranges; empty: nothing
          lost_pairs: number; // That it would lose [pairs]
        } | null; // Which is likelier than the dump's; null: none is
      }>; // In the order of the dump
      methods: Array<{
        name: string; // As in `clusterbench list`
        listed_pairs: number; // Pairs in its lists [pairs]
        false_positives: number; // Of them not true [pairs]
        lost_pairs: number; // True pairs that it does not list [pairs]
        packed_bytes: number; // Of its lists as `packed` [bytes]
      }>; // On the same frame; empty with --methods none
      methods_left_out: string[]; // Of those that were asked for: would take too long on this frame
    }; // Its verdict
    grid: {
      shape: "slopes" | "shells" | "box"; // slopes: x / depth, y / depth, depth; shells: the same with the distance; box: x, y, z of view space or of the world
      x: number[]; // Planes of columns, ascending
      y: number[]; // Planes of rows, descending where row 0 is at the top
      z: number[]; // Ends of slices, ascending; of a box in view space minus depth, descending
      rotation: [Vector, Vector, Vector]; // Of a box: view space = rotation (point - origin)
      origin: Vector; // See rotation
    }; // Its cells
    sides: [number, number, number, number]; // Left, right, bottom, top of the picture at depth 1, or in metres
    orthographic: boolean; // Of the camera
    lights: Array<{
      index: number; // In the dump
      position: Vector; // In view space, which looks along -z
      range_m: number | null; // null: no end [m]
      direction?: Vector; // Of a spot
      half_angle_rad?: number; // Of a spot [radians]
    }>; // Those that the lists of its cells name
    sets: Array<{
      name: string; // Of the set
      cells: Array<{
        index: number; // x fastest, from the top, from the near end
        reach_percent: number; // Of its deepest lost light, of its range [percent]
        listed: number[]; // Lights in the engine's list
        lost: number[]; // Lights that reach the cell and are not listed
        excess: number[]; // Listed lights that do not reach the cell
      }>; // Those of the most deeply lost pairs, the deepest first
      cells_left_out: number; // Further ones of these pairs, which have no room in the page
    }>; // In the order of the dump; those that could not be read have no cells
  }>; // In the order of the command line
};
