#pragma once
// Allocations: the output of `clusterbench size --format json`.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct SizeSearch {
  static constexpr const char* k_definition = "search";
  static About about() { return About("A search for worse frames"); }
  RECORD(SizeSearch);
  FIELD_AS("case", std::string, searched, "That was searched");
  FIELD(std::string, measure, "What was made as large as possible, by its name in `worst-case --measure`");
  FIELD(std::optional<std::string>, refusal, "Why it was not");
  FIELD(std::optional<std::uint64_t>, evaluations, "Frames tried", "frames");
  FIELD(std::optional<std::uint64_t>, seed, "Of all that is random");
  FIELD(std::optional<std::string>, flags,
        "That say what the search may choose, as --keep-height; empty: none was given, or an earlier version searched");
  FIELD(std::optional<std::vector<double>>, eye_m,
        About("Where the camera of the worst frame stands", "m").finite().items(3, 3).as_fraction());
  FIELD(std::optional<std::vector<double>>, direction,
        About("Along which that camera looks; absent where an earlier version searched")
            .finite()
            .items(3, 3)
            .as_fraction());
  END_RECORD;
};

struct ElementSpread {
  static constexpr const char* k_definition = "spread";
  static About about() { return About("Elements of a frame; nearest rank"); }
  RECORD(ElementSpread);
  FIELD(std::uint64_t, min, "Smallest", "elements");
  FIELD(std::uint64_t, p50, "Median", "elements");
  FIELD(std::uint64_t, p90, "90th percentile", "elements");
  FIELD(std::uint64_t, p99, "99th percentile", "elements");
  FIELD(std::uint64_t, max, "Largest", "elements");
  FIELD(bool, is_exact,
        "False where results of long paths have the largest of several frames as one number: then percentiles are "
        "upper bounds");
  END_RECORD;
};

struct WorstNeed {
  RECORD(WorstNeed);
  FIELD(std::string, camera, "Whose path it is on");
  FIELD(std::uint64_t, frame, "Of its path, the first one", "frame");
  FIELD(std::optional<CellIndex>, cell,
        "[x, y, z] of the cell that has this frame's longest list; absent without cells");
  END_RECORD;
};

struct ViewGroup {
  RECORD(ViewGroup);
  FIELD(std::vector<std::string>, cameras, About("In one frame").items(1, 0));
  FIELD(std::uint64_t, count, "Of their frames", "frames");
  FIELD(std::uint64_t, high_water, "That their worst frame needs", "elements");
  FIELD(Nullable<ElementSpread>, frames,
        "Elements of a frame; null where their paths have different numbers of frames");
  END_RECORD;
};

struct HighWaterOfEvery {
  RECORD(HighWaterOfEvery);
  FIELD(std::uint64_t, every, About("Which frames").at_least(1));
  FIELD(std::uint64_t, high_water, "Of these frames", "elements");
  END_RECORD;
};

struct NeverOverflows {
  RECORD(NeverOverflows);
  FIELD(std::uint64_t, elements, "Every light in every cell", "elements");
  FIELD(std::uint64_t, bytes, "Of them", "bytes");
  END_RECORD;
};

struct ChanceOfFrame {
  RECORD(ChanceOfFrame);
  FIELD(double, estimate,
        About("Share of frames; 0: never, as far as the fit tells").finite().at_least(0).at_most(1).as_fraction());
  FIELD(Pair, ci95, About("95 % profile-likelihood interval").finite().at_least(0).at_most(1).as_fraction());
  END_RECORD;
};

struct RareCapacity {
  RECORD(RareCapacity);
  FIELD(std::uint64_t, estimate, "By the fit", "elements");
  FIELD(std::uint64_t, upper, "With 97.5 % confidence enough; at most the theoretical maximum", "elements");
  END_RECORD;
};

struct BeyondThePath {
  RECORD(BeyondThePath);
  FIELD(std::optional<std::string>, refusal, "Why there is no estimate; then nothing else is here");
  FIELD(std::optional<ChanceOfFrame>, above_capacity, "That a frame needs more than the capacity");
  FIELD(std::optional<ChanceOfFrame>, above_high_water, "That a frame needs more than any recorded one");
  FIELD(std::optional<RareCapacity>, capacity_for_1_in_100000, "What one of 100000 frames exceeds");
  FIELD(std::optional<bool>, fits,
        "Whether the fit is good (fit_p of 0.1 or more). If not, the other numbers are not to be relied on");
  FIELD(std::optional<double>, fit_p,
        About("Share of samples drawn from the fit that fit themselves worse, by Anderson and Darling")
            .finite()
            .at_least(0)
            .at_most(1)
            .as_fraction());
  FIELD(std::optional<std::uint64_t>, frames, "Recorded", "frames");
  FIELD(std::optional<std::uint64_t>, threshold, "Peaks are above it", "elements");
  FIELD(std::optional<std::uint64_t>, frames_above, "Above the threshold", "frames");
  FIELD(std::optional<std::uint64_t>, peaks, "Clusters of frames above the threshold", "peaks");
  FIELD(std::optional<std::uint64_t>, cut_peaks, "Of these highest at an end of their path", "peaks");
  FIELD(std::optional<double>, extremal_index,
        About("Peaks per frame above the threshold, by the distances between such frames")
            .finite()
            .at_least(0)
            .at_most(1)
            .as_fraction());
  FIELD(std::optional<double>, shape,
        About("Of the generalised Pareto distribution; below 0: needs have an end").finite().as_fraction());
  FIELD(std::optional<double>, scale, About("Of the same", "elements").finite().at_least(0).as_fraction());
  FIELD(std::optional<double>, end,
        About("No frame needs more, as far as the fit tells; absent without an end", "elements")
            .finite()
            .at_least(0)
            .as_fraction());
  FIELD(std::optional<bool>, is_upper_bound,
        "True where results of long paths have the largest of several frames as one number: chances are upper bounds");
  END_RECORD;
};

struct AllocatedBuffer {
  RECORD(AllocatedBuffer);
  FIELD(std::string, name, "As the structure names it: indices, headers, words, nodes ...");
  FIELD(std::string, identifier, "Its name in code");
  FIELD(std::uint64_t, element_bytes, About("Size of an element", "bytes").at_least(1));
  FIELD(std::uint64_t, high_water, "That the worst frame of any camera needs so that nothing is dropped", "elements");
  FIELD(std::uint64_t, theoretical_max, "That any frame could need", "elements");
  FIELD(WorstNeed, worst, "The frame that made the high-water mark");
  FIELD(std::optional<std::uint64_t>, views_apart, "Of cameras in one frame: if each needed its most at the same time",
        "elements");
  FIELD(std::optional<std::string>, views_not_paired,
        "Why high_water is views_apart: their paths have other numbers of frames, or frames at other times; absent "
        "where it is not");
  FIELD(std::optional<ElementSpread>, frames,
        "Elements of a frame, over all frames of all cameras; with views of the cameras that made the high water. "
        "Absent in results of earlier versions");
  FIELD(std::optional<std::vector<ViewGroup>>, groups,
        "With views: what cameras need that are in one buffer in one frame, and those that have it alone, each apart. "
        "Absent without");
  FIELD(std::optional<std::vector<HighWaterOfEvery>>, high_water_of_every,
        "High water of every 8th, 4th, 2nd and of all frames: while it grows, frames between those counted need more. "
        "Absent for few frames and for results of long paths");
  FIELD(std::optional<std::uint64_t>, found, "Of the worst frame that any search found; absent without", "elements");
  FIELD(std::optional<SizeSearch>, found_by, "The search that found it; absent without");
  FIELD(bool, is_bounded,
        About("Whether theoretical_max holds for frames that were not counted, too: not where they can have more "
              "lights or cells in these lists")
            .late());
  FIELD(std::optional<NeverOverflows>, never_overflows,
        "An allocation that needs no check with these lights; absent where there is none");
  FIELD(std::uint64_t, capacity,
        "To allocate: the larger one of high water and found x margin, at most the theoretical maximum, and what else "
        "fits into the rounded bytes",
        "elements");
  FIELD(std::uint64_t, warn_above, "Warn of a frame that needs more; the capacity itself where nothing can overflow",
        "elements");
  FIELD(std::uint64_t, bytes, "Of the allocation", "bytes");
  FIELD(std::uint64_t, double_buffered_bytes, "Of two of them", "bytes");
  FIELD(std::optional<BeyondThePath>, beyond_the_path,
        "Peaks over a threshold: how likely a frame of this kind that was not recorded exceeds the buffer. Absent "
        "where no frame can, and where all need the same");
  END_RECORD;
};

struct WithOwnValue {
  RECORD(WithOwnValue);
  FIELD(std::uint64_t, value, About("That the engine comes with", "as needed").at_least(1));
  FIELD(std::optional<std::uint64_t>, lost,
        "Lights that the worst frame or list, or the scene, loses with it; absent where tiles grow in place of that",
        "lights");
  FIELD(std::optional<std::uint64_t>, frames, "Where tiles grow: frames that were looked at", "frames");
  FIELD(std::optional<std::uint64_t>, frames_with_grown_tiles, "Of them with other tiles than asked for", "frames");
  FIELD(std::optional<std::uint64_t>, frames_over, "Of them whose lists do not fit even in the tiles that they have",
        "frames");
  FIELD(std::optional<Counts2>, fewest_tiles, About("Columns and rows of the coarsest frame", "tiles").at_least(1));
  FIELD(std::optional<std::uint64_t>, entries, "The most that a frame's lists take in its own tiles", "entries");
  END_RECORD;
};

struct EngineLimit {
  RECORD(EngineLimit);
  FIELD(std::string, name, "As the engine has it");
  FIELD(std::string, needed, "What it has to have room for");
  FIELD(Nullable<std::uint64_t>, seen,
        "The most seen; null: the result does not say, or its lists are those behind the engine's limit on lights");
  FIELD(Nullable<std::uint64_t>, found, "The most that a search found; null: not looked for");
  FIELD(std::optional<SizeSearch>, search,
        "The search that found most of it, a refused one if there is no other; absent without");
  FIELD(Nullable<std::uint64_t>, value, "To set; null: not known, no light was seen, or compiled into the engine");
  FIELD(std::optional<std::uint64_t>, value_for_all,
        "The largest `value` of all structures that share the engine's setting: scenes and viewports of one grid; "
        "absent where value is null",
        "as needed");
  FIELD(Nullable<std::uint64_t>, most, "That the engine takes; null: no such bound");
  FIELD(bool, is_too_much, "Whether frames need more than the engine takes");
  FIELD(std::optional<std::uint64_t>, lost,
        About("With is_too_much: lights, or entries of lists, that the worst frame or list loses", "lights or entries")
            .at_least(1));
  FIELD(std::optional<WithOwnValue>, with_own_value,
        "What these frames get with the value that the engine comes with; absent where it comes with none, or that is "
        "not known");
  END_RECORD;
};

struct EngineSettings {
  RECORD(EngineSettings);
  FIELD(std::string, engine, "Whose preset was measured");
  FIELD(std::string, version, "And where the settings are");
  FIELD(std::string, grid, "What sets the grid; empty where nothing does");
  FIELD(std::vector<EngineLimit>, limits, "Each setting");
  END_RECORD;
};

struct CamerasInOneFrame : std::vector<std::string> {
  static constexpr const char* k_definition = "cameras_in_one_frame";
  static About about() { return About("Cameras that are in one buffer in one frame").items(2, 0); }
};

struct GuestCamera {
  RECORD(GuestCamera);
  FIELD(std::string, camera, "Whose samples");
  FIELD(std::uint64_t, samples, "Over all frames", "samples");
  FIELD(std::uint64_t, outside, "Of them outside of the grid", "samples");
  FIELD(std::uint64_t, needed, "Lights that reach the samples", "lights");
  FIELD(std::uint64_t, missed, "Of them not given", "lights");
  FIELD(std::uint64_t, missed_outside, "Of the missed, at samples outside", "lights");
  FIELD(std::uint64_t, worst_frame, "In which most are missed", "frame");
  END_RECORD;
};

struct SharedLookup {
  RECORD(SharedLookup);
  FIELD(std::string, identifier, "What its names in code begin with");
  FIELD(std::vector<std::string>, cameras, "That share it");
  FIELD(Json, constants, About("As docs/grids-and-lookups.md names them: numbers, or lists of numbers").shaped(R"({
          "type": "object",
          "additionalProperties": {
            "anyOf": [
              {"type": ["number", "null"]},
              {"type": "array", "items": {"type": ["number", "null"]}}
            ]
          }
        })"));
  END_RECORD;
};

struct AllocatedStructure {
  RECORD(AllocatedStructure);
  FIELD(std::string, name, "Name of its cases without the camera");
  FIELD(std::string, identifier, "What its names in code begin with");
  FIELD(std::string, scene, "Name of the scene");
  FIELD(std::vector<std::string>, cameras, "Whose frames are counted");
  FIELD(std::string, grid, "Name of the grid");
  FIELD(std::string, assigner, "The method, with the parameters that differ from their defaults");
  FIELD(std::string, storage, "The storage; own: the method's own structure");
  FIELD(std::uint64_t, bytes, "Of all buffers", "bytes");
  FIELD(std::uint64_t, frames,
        About("Counted: of all cameras, or of cameras in one frame, each frame once", "frames").late());
  FIELD(std::optional<std::vector<CamerasInOneFrame>>, views,
        "Cameras that are in one buffer in one frame; absent without");
  FIELD(std::optional<std::vector<GuestCamera>>, guests,
        "Cameras without a grid of their own, whose samples are looked up in this one; absent without");
  FIELD(std::optional<SizeSearch>, search,
        "Of all searches for worse frames (--worst-case, --found) the one that found most for the first buffer of "
        "which one found anything; absent without a search");
  FIELD(std::optional<std::string>, choice,
        "That the conclusion of the result takes it, or that it takes another method and why this structure is here; "
        "absent where neither is so, as where scenes are counted");
  FIELD(Nullable<std::string>, nothing_seen,
        "Why the frames that were counted say nothing of what frames with lights need: no light was ever in view, or "
        "no list had one. Sizes are then of nothing, unless a search found some. null: lights were seen");
  FIELD(std::uint64_t, dropped_pairs, "That the storage had no room for where it was measured; the capacities have",
        "pairs");
  FIELD(std::optional<std::vector<std::string>>, grid_notes,
        "What the grid's capacities rest on, such as a far end where the camera has none; absent where there is "
        "nothing to say");
  FIELD(std::optional<std::vector<std::string>>, limit_notes,
        "Limits on lights or room of the clustering's own that were reached: the capacities are those of what is left. "
        "Absent where none was");
  FIELD(std::optional<std::string>, no_reader,
        "Why hlsl and glsl have no function that reads its lists; absent where they have one");
  FIELD(std::vector<AllocatedBuffer>, buffers, "Each buffer");
  FIELD(std::vector<SharedLookup>, lookups,
        "Constants of a sample's lookup; several where cameras have different grids, none of a method's own structure");
  FIELD(std::optional<EngineSettings>, settings, "With --engine: the same in the engine's own settings");
  END_RECORD;
};

struct Size {
  RECORD(Size);
  FIELD(int, size_version, About("Grows whenever a name or a meaning changes").always(1));
  FIELD(double, margin, About("Capacity / high water", "ratio").finite().at_least(1).as_fraction());
  FIELD(double, warn_at,
        About("Share of the capacity above which to warn", "share of 1").finite().at_least(0).as_fraction());
  FIELD(std::string, rounding, About("Of a buffer's bytes").one_of({"page", "power-of-two", "none"}));
  FIELD(std::uint64_t, structures_in_all, "Of the result, as far as the filter matches", "structures");
  FIELD(std::vector<AllocatedStructure>, structures, "Of each scene and grid one; with --all each");
  END_RECORD;
};

Json size_schema();

extern template const Type& type_of<Size>();

}  // namespace clusterbench::result
