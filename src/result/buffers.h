#pragma once
// Occupancy of cells, and memory of lists.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct Histogram {
  RECORD(Histogram);
  FIELD(std::uint64_t, lights_per_entry,
        About("More than 1 where lists are longer than 255: an entry counts cells with this many lengths", "lights",
              "the case")
            .at_least(1));
  FIELD(std::vector<std::uint64_t>, cells,
        About("[n]: cells with n * lights_per_entry lights, up to those of the next entry", "cells").items(0, 256));
  END_RECORD;
};

struct LightsPerCell {
  RECORD(LightsPerCell);
  FIELD(double, mean, "Arithmetic mean");
  FIELD(double, p50, "Median");
  FIELD(double, p95, "95th percentile");
  FIELD(double, p99, "99th percentile");
  FIELD(double, max, "Largest");
  FIELD(Histogram, histogram, "Cells by the length of their lists", Compares::follows);
  END_RECORD;
};

struct PairsAlongPath {
  RECORD(PairsAlongPath);
  FIELD(std::uint64_t, frames_per_entry,
        About("More than 1 on paths of more than 512 frames: an entry is the largest of so many", "frames", "the case")
            .at_least(1));
  FIELD(std::vector<std::uint64_t>, pairs, About("Pairs (cell, light) of each frame", "pairs").items(0, 512));
  FIELD(std::vector<std::uint64_t>, longest_list, About("In the fullest cell of the frame", "lights").items(0, 512));
  END_RECORD;
};

struct Occupancy {
  static About about() { return About("", Compares::follows); }
  RECORD(Occupancy);
  FIELD(Spread, pairs, "(cell, light) pairs of a frame", "pairs", "all frames", Compares::cost);
  FIELD(LightsPerCell, lights_per_cell, "Lights in a cell's list; percentiles are nearest-rank", "lights",
        "all cells of all frames", Compares::cost);
  FIELD(Spread, occupied_fraction, "Share of the cells with a light", "share of 1", "all frames");
  FIELD(std::uint64_t, worst_frame, "Frame with the longest list", "frame", "the path");
  FIELD(CellIndex, worst_cell, "Cell with the longest list");
  FIELD(PairsAlongPath, along_path, "Frame by frame", "", "each frame");
  FIELD(std::optional<std::vector<std::uint64_t>>, longest_by_slice,
        "[z]: in the fullest cell of that slice, in cascades of that layer of cells of a level; absent in world grids, "
        "where slices move along the path, and for methods with cells of their own",
        "lights", "all frames");
  END_RECORD;
};

struct FrameBytes {
  RECORD(FrameBytes);
  FIELD(double, mean, "Mean per frame");
  FIELD(std::uint64_t, max, "Of the frame with most");
  END_RECORD;
};

struct Overflow {
  RECORD(Overflow);
  FIELD(std::uint64_t, dropped_pairs, "That the storage had no room for", "pairs", "all frames");
  FIELD(std::uint64_t, cells, "In which pairs were dropped, counted in each frame", "cells", "all frames");
  FIELD(std::uint64_t, frames, "In which pairs were dropped", "frames", "all frames");
  FIELD(std::vector<std::uint64_t>, lights, "Indices of those that were dropped anywhere", "light index", "all frames",
        Compares::follows);
  END_RECORD;
};

struct BytesAlongPath {
  RECORD(BytesAlongPath);
  FIELD(std::uint64_t, frames_per_entry,
        About("More than 1 on paths of more than 512 frames: an entry is the largest of so many", "frames", "the case")
            .at_least(1));
  FIELD(std::vector<std::uint64_t>, bytes, About("Headers and indices of the frame", "bytes").items(0, 512));
  END_RECORD;
};

struct ElementsAlongPath {
  RECORD(ElementsAlongPath);
  FIELD(std::uint64_t, frames_per_entry,
        About("More than 1 on paths of more than 512 frames: an entry is the largest of so many", "frames", "the case")
            .at_least(1));
  FIELD(std::vector<std::uint64_t>, elements, About("That the frame needs", "elements").items(0, 4096));
  END_RECORD;
};

struct Buffer {
  RECORD(Buffer);
  FIELD(
      std::string, name,
      About("indices, headers, header_blocks (packed), counts (fixed), words (bitfield), nodes, heads (linked), masks, "
            "bins, order (z-binning), boxes (bvh), growths (tile-slices); other methods' have names of their own")
          .matches("^[a-z][a-z_]*$"));
  FIELD(std::uint64_t, element_bytes, About("Size of an element", "bytes", "one element").at_least(1));
  FIELD(std::uint64_t, step, About("Elements come in multiples of it", "elements", "the worst frame").at_least(1));
  FIELD(std::uint64_t, high_water, "That the worst frame needs", "elements", "all frames");
  FIELD(std::uint64_t, theoretical_max, "That any frame could need with this grid and these lights", "elements",
        "all frames");
  FIELD(std::uint64_t, worst_frame, "That made the high-water mark, the first one", "frame", "the path");
  FIELD(std::optional<CellIndex>, worst_cell, "That has this frame's longest list; absent without cells");
  FIELD(std::optional<ElementsAlongPath>, along_path, "Frame by frame; absent where every frame needs high_water", "",
        "each frame");
  END_RECORD;
};

struct Buffers {
  static About about() { return About("", Compares::cost); }
  RECORD(Buffers);
  FIELD(HighWater, index_entries, "Entries of all lists", "entries", "all frames");
  FIELD(HighWater, bytes, "Headers and indices", "bytes", "all frames");
  FIELD(
      std::uint64_t, index_bits,
      About(
          "Of an entry: a light index, a word of a bitfield or of tile masks, a node of linked lists or of a hierarchy",
          "bits", "one entry")
          .at_least(1));
  FIELD(std::uint64_t, header_bytes,
        "Of bytes, those whose number does not depend on the lights: offsets and counts of the cells", "bytes",
        "one frame");
  FIELD(FrameBytes, upload_bytes, "What a frame would send to a GPU", "bytes", "all frames");
  FIELD(MeanMax, used_share, "Entries that a frame uses, of index_entries.recommended", "share of 1", "all frames",
        Compares::follows);
  FIELD(Overflow, overflow, "What a full storage loses");
  FIELD(std::optional<std::uint64_t>, repeated_pairs,
        "Of a user's shader: a light in a list where it is already, and would be added again; absent: none", "pairs",
        "all frames");
  FIELD(std::uint64_t, scratch_bytes, "The assigner's own memory, the most it held", "bytes", "all frames");
  FIELD(std::uint64_t, worst_frame, "That made the high-water mark", "frame", "the path", Compares::follows);
  FIELD(std::optional<FrameBytes>, traffic_bytes,
        "What a GPU reads and writes for lights that are drawn over pixels; absent where none are", "bytes",
        "all frames");
  FIELD(std::optional<CellIndex>, worst_cell, "That has this frame's longest list; absent without cells",
        Compares::follows);
  FIELD(BytesAlongPath, along_path, "Frame by frame", "", "each frame", Compares::follows);
  FIELD(std::optional<std::vector<Buffer>>, each,
        About("Each buffer of the structure as an engine allocates it: what it needs so that nothing is dropped",
              Compares::follows)
            .late());
  END_RECORD;
};

}  // namespace clusterbench::result
