#pragma once
// Changes from frame to frame: slices that follow, tiles that react, storages that fall back, pairs that flicker.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct Saved {
  static constexpr const char* k_definition = "saved";
  static About about() { return About("", "share", "the case"); }
  RECORD(Saved);
  FIELD(std::optional<double>, pairs, "Pairs in lists, mean per frame");
  FIELD(std::optional<double>, false_positives, "Pairs that are not true");
  FIELD(std::optional<double>, lists_changed, "Lists that differ from the frame before's");
  FIELD(double, index_entries, "High-water mark of the entries to allocate");
  FIELD(double, bytes, "High-water mark of all bytes to allocate");
  FIELD(ByName<double>, evaluated, About("Lights that samples loop over, by the set of samples").each("Of a set"));
  END_RECORD;
};

struct FitSide {
  static constexpr const char* k_definition = "fit_side";
  static About about() { return About("", "", "frames"); }
  RECORD(FitSide);
  FIELD(std::optional<double>, pairs,
        About("In lists, mean per frame; absent without cells", "pairs").finite().at_least(0));
  FIELD(std::optional<std::uint64_t>, true_pairs,
        "Over all frames; absent without cells, or where accuracy is not checked", "pairs", Compares::fixed);
  FIELD(std::optional<std::uint64_t>, false_positives, "Over all frames: pairs in lists that are not true", "pairs");
  FIELD(std::optional<double>, lists_changed,
        "Share of the lists that differ from those of the same cells in the frame before; absent without cells, null "
        "with one frame",
        "share");
  FIELD(std::uint64_t, index_entries, "High-water mark", "entries");
  FIELD(std::uint64_t, bytes, "High-water mark of all that is allocated", "bytes");
  FIELD(ByName<std::uint64_t>, evaluated,
        About("Lights that samples loop over, by the set of samples", "lights").each("Of a set"));
  FIELD(ByName<std::uint64_t>, missed,
        About("Lights that samples need and do not get, by the set of samples", "lights").each("Of a set"));
  END_RECORD;
};

struct Ends {
  RECORD(Ends);
  FIELD(double, near, About("First boundary").finite());
  FIELD(double, far, About("Last boundary").finite());
  END_RECORD;
};

struct GridMoves {
  RECORD(GridMoves);
  FIELD(std::uint64_t, steps, "From a frame to the next", "steps", "the path");
  FIELD(std::uint64_t, changed, "Steps to a grid with other boundaries; a method is then built again", "steps",
        "the path");
  FIELD(double, cells, "Share of the cells that are other ones than in the frame before, mean; null with one frame",
        "share", "the steps");
  FIELD(Extremes, boundaries, "How far a boundary moves, in thicknesses that the slice before it had", "slices",
        "boundaries of all steps");
  END_RECORD;
};

struct Fit {
  RECORD(Fit);
  FIELD(std::string, to, About("What is followed").one_of({"lights", "surfaces", "both", "ranges"}));
  FIELD(double, damping,
        About("Share of a shrinking that is left after one frame", "ratio", "the case").finite().as_fraction());
  FIELD(double, step,
        About("Ends lie at powers of this factor; 1: anywhere", "ratio", "the case").finite().as_fraction());
  FIELD(Ends, asked, "Ends of the slices that do not follow, in the last frame", "m", "the case");
  FIELD(Extremes, near,
        "Where slices begin, of exponential-first ones where the first one ends; null where no frame needs anything",
        "m", "frames that need something");
  FIELD(Extremes, far, "Where slices end", "m", "frames");
  FIELD(GridMoves, moves, "How the grid changes from frame to frame");
  FIELD(FitSide, fitted, "This case", Compares::cost);
  FIELD(FitSide, unfitted, "The same case in the grid that does not follow", Compares::cost);
  FIELD(Saved, saved, "1 - fitted / unfitted: below 0 where following costs; null where the unfitted case has none",
        Compares::follows);
  END_RECORD;
};

struct ReactingTiles {
  RECORD(ReactingTiles);
  FIELD(Counts2, asked, About("Across and down, where nothing makes them larger", "tiles", "the case").at_least(1));
  FIELD(Counts2, fewest, About("The fewest across and the fewest down", "tiles", "frames").at_least(1));
  FIELD(Extremes, per_frame, "In a frame", "tiles", "frames");
  END_RECORD;
};

struct ReactingFrames {
  RECORD(ReactingFrames);
  FIELD(std::uint64_t, reacted, "With other tiles than asked for", "frames", "the path");
  FIELD(std::uint64_t, over, "That need more than there is room for in their own tiles", "frames", "the path");
  END_RECORD;
};

struct TileMoves {
  RECORD(TileMoves);
  FIELD(std::uint64_t, steps, "From a frame to the next", "steps", "the path");
  FIELD(std::uint64_t, changed, "Steps to other tiles; a method is then built again, and all lists are new", "steps",
        "the path", Compares::cost);
  END_RECORD;
};

struct Reaction {
  RECORD(Reaction);
  FIELD(std::string, to,
        About("What tiles react to: entries of lists in the frame before, or words of masks in the frame itself")
            .one_of({"entries", "mask-words"}));
  FIELD(std::uint64_t, most, About("Entries or words that there is room for", "entries", "the case").at_least(1));
  FIELD(std::optional<std::string>, of, "The method whose lists are counted; only of entries");
  FIELD(std::optional<std::uint64_t>, most_lights,
        About("Lights that get a bit at most; absent without a limit", "lights", "the case").at_least(1));
  FIELD(ReactingTiles, tiles, "Tiles of the frames", Compares::follows);
  FIELD(Extremes, needed, "Entries of the counted method's lists, or words, in a frame's own tiles", "entries",
        "frames", Compares::cost);
  FIELD(ReactingFrames, frames, "Frames of the path", Compares::cost);
  FIELD(TileMoves, moves, "How tiles change from frame to frame");
  FIELD(FitSide, reacting, "This case", Compares::cost);
  FIELD(std::optional<FitSide>, fixed,
        "The same case in the tiles asked for; absent where these make more than a million cells", Compares::cost);
  FIELD(std::optional<Saved>, saved,
        "1 - reacting / fixed: below 0 where reacting costs; null where the other case has none; absent without it",
        Compares::follows);
  END_RECORD;
};

struct Fallback {
  RECORD(Fallback);
  FIELD(std::uint64_t, frames, "With a cell that reads all lights", "frames", "the path");
  FIELD(std::uint64_t, cells, "That read all lights", "cells", "all frames");
  FIELD(FitSide, limited, "This case");
  FIELD(FitSide, roomy, "The same case with room for all lists");
  FIELD(Saved, saved, "1 - limited / roomy: below 0 where falling back costs; null where the other case has none",
        Compares::follows);
  END_RECORD;
};

struct Changed {
  RECORD(Changed);
  FIELD(Churn, method, "In the method's lists", Compares::cost);
  FIELD(Churn, truth, "In the true lists");
  END_RECORD;
};

struct Flickers {
  RECORD(Flickers);
  FIELD(std::uint64_t, method, "In the method's lists", Compares::cost);
  FIELD(std::uint64_t, truth, "In the true lists");
  END_RECORD;
};

struct ExcessChurn {
  RECORD(ExcessChurn);
  FIELD(std::int64_t, pairs, "Below 0 where the truth has more", "pairs");
  FIELD(double, ratio, "Divided by those of the truth; null where the truth has none", "ratio");
  END_RECORD;
};

struct ExcessFlickers {
  RECORD(ExcessFlickers);
  FIELD(std::int64_t, count, "Below 0 where the truth has more", "changes");
  FIELD(double, ratio, "Divided by those of the truth; null where the truth has none", "ratio");
  END_RECORD;
};

struct Stability {
  RECORD(Stability);
  FIELD(std::uint64_t, steps, "Steps taken: fewer than asked for where the path ends or the camera stands still",
        "steps", "the piece of the path");
  FIELD(double, step_m, "Largest move of the camera in one step", "m", "the steps");
  FIELD(double, step_deg, "Largest turn of the camera in one step, in degrees", "degrees", "the steps");
  FIELD(std::uint64_t, window, About("Steps within which a change back is a flicker", "steps", "the case").at_least(1));
  FIELD(std::uint64_t, from_frame, "Frame of the path where the steps begin", "frame", "the path");
  FIELD(bool, drift, "The camera stands still and was moved artificially, as path says");
  FIELD(std::string, path, "Where the steps come from");
  FIELD(std::uint64_t, grids, "Grids made along the steps; with more than one, cells themselves move", "grids",
        "the steps");
  FIELD(Changed, changed, "Pairs (cell, light) added or removed from one step to the next");
  FIELD(Flickers, flickers, "Changes that undo the same pair's change at most `window` steps before, over all steps",
        "changes", "the steps");
  FIELD(ExcessChurn, excess_churn, "Changes of the method less those of the truth", "", "the steps", Compares::cost);
  FIELD(ExcessFlickers, excess_flickers, "Flickers of the method less those of the truth", "", "the steps",
        Compares::cost);
  FIELD(std::uint64_t, undecided,
        "Pairs of the truth that exact arithmetic left undecided, over all steps; counted as true", "pairs",
        "the steps");
  END_RECORD;
};

}  // namespace clusterbench::result
