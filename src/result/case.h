#pragma once
// One case: a method on a grid in a storage, along a camera's path.

#include "result/buffers.h"
#include "result/details.h"
#include "result/frames.h"
#include "result/grid.h"
#include "result/reading.h"
#include "result/samples.h"
#include "result/shadows.h"
#include "result/timing.h"

namespace clusterbench::result {

struct CameraPath {
  RECORD(CameraPath);
  FIELD(double, from_s, About("Time of the first frame", "s", "the path").finite());
  FIELD(double, to_s, About("Time of the last frame", "s", "the path").finite());
  FIELD(std::optional<std::string>, digest,
        "The same for the same motion and projection, whatever the file is and in however many frames it is measured; "
        "absent for a path that was made for a scene without cameras");
  END_RECORD;
};

struct Method {
  RECORD(Method);
  FIELD(std::string, name, "As `clusterbench list` has it");
  FIELD(std::string, label, "Name with the parameters that differ from their defaults");
  FIELD(Json, params, "All parameters, with their defaults");
  FIELD(bool, conservative,
        "Never misses a true pair; a miss fails the run. False on packed lights that are not inflated");
  FIELD(bool, exact, "Conservative, and lists nothing that is not true");
  FIELD(
      std::optional<bool>, on_device,
      "true: it runs on the result's device, whose clock times it (device); there is no timing. Absent: it runs on the "
      "processor");
  FIELD(std::optional<std::string>, file, "Of a method that is not built in: the name of its file", Compares::skipped);
  FIELD(std::optional<std::string>, sha256,
        "And of all of its files together. No part of the case's id, so that two versions compare", Compares::skipped);
  END_RECORD;
};

struct Failure {
  RECORD(Failure);
  FIELD(std::string, kind,
        About("Of a conservative or exact method: lost_pairs in lists, lost_at_samples without cells. extra_pairs: of "
              "an exact one. dropped_pairs: beyond limits.dropped_pairs of the configuration. wrong_readings: a device "
              "walked other lights than the structure has (reading). crashed, timed_out, out_of_memory, failed: of a "
              "plug-in, after the case was measured, as in broken")
            .one_of({"lost_pairs", "extra_pairs", "lost_at_samples", "dropped_pairs", "wrong_readings", "crashed",
                     "timed_out", "out_of_memory", "failed"}));
  FIELD(std::string, text, "The same for people, without the case's name");
  END_RECORD;
};

struct Warning {
  RECORD(Warning);
  FIELD(std::string, kind,
        About("dropped_pairs: the storage was full. unlit: more than 0.001 of the lights that samples need are not "
              "given. undecided: pairs that exact arithmetic left open. lost_pairs: of a method that is not "
              "conservative. unchecked: no truth to hold the lists against. too_many_lights: frames have more lights "
              "than a limit lets in. repeated_lights: lights are twice in a list")
            .one_of({"dropped_pairs", "unlit", "undecided", "lost_pairs", "unchecked", "too_many_lights",
                     "repeated_lights"}));
  FIELD(std::string, text, "The same for people, without the case's name", "", "", Compares::unjudged);
  END_RECORD;
};

struct LightsByType {
  RECORD(LightsByType);
  FIELD(std::uint64_t, point, "Point lights");
  FIELD(std::uint64_t, spot, "Spot lights");
  FIELD(std::uint64_t, box, "Boxes");
  END_RECORD;
};

struct LightsInView {
  RECORD(LightsInView);
  FIELD(double, mean, About("Over the frames", "", "all frames").finite().at_least(0));
  FIELD(std::uint64_t, max, "In the frame with most", "", "the worst frame");
  FIELD(std::uint64_t, frames_at_max, About("How many frames have as many", "frames", "all frames").at_least(1));
  FIELD(std::uint64_t, worst_frame, "The first of them", "index", "the path");
  FIELD(LightsByType, max_by_type, "Of each type by itself, in the frame that has most of it", "", "the worst frame");
  FIELD(std::optional<double>, shining_mean,
        About("Of those in view the ones that shine in the frame, mean over the frames. Absent in older results", "",
              "all frames")
            .finite()
            .at_least(0)
            .late());
  END_RECORD;
};

struct LightsBeyondGrid {
  RECORD(LightsBeyondGrid);
  FIELD(std::uint64_t, max, "In the frame with most; 0: none ever does", "", "the worst frame");
  FIELD(std::uint64_t, frames, "How many frames have such a light", "frames", "all frames");
  END_RECORD;
};

struct SetCost {
  RECORD(SetCost);
  FIELD(double, samples, "That a frame shades: weight x samples, each of which stands for its block of pixels",
        "samples", "", Compares::fixed);
  FIELD(double, lights, "Looped over at one of them, mean", "lights");
  FIELD(double, divergence, "Of waves of config.cost.wave pixels; 1 where it is not known, and where lights are drawn",
        "ratio");
  FIELD(std::optional<double>, reads,
        "Elements of the light structure (headers, indices, words of bits, nodes) that one of them fetches to know its "
        "lights, mean; 0 where lights are drawn",
        "elements");
  FIELD(std::optional<double>, read_bytes, "Their bytes, mean", "B");
  FIELD(double, ns, "samples x divergence x (lights x ns_per_light + reads x ns_per_read + read_bytes / read_gb_per_s)",
        "ns");
  END_RECORD;
};

struct Cost {
  static About about() { return About("", Compares::cost); }
  RECORD(Cost);
  FIELD(double, frame_ns,
        "assign_ns + gpu_ns; null where nothing is timed, and of presets whose engine makes its lists on a GPU, which "
        "is not timed here",
        "ns", Compares::skipped);
  FIELD(double, assign_ns, "timing.frame_ns.median: assignment and conversion", "ns", Compares::skipped);
  FIELD(double, gpu_ns,
        "upload_ns + traffic_ns + read_ns + shade_ns: all but the assignment, and the same on every machine", "ns");
  FIELD(double, upload_ns,
        "buffers.upload_bytes.mean / upload_gb_per_s; 0 of presets whose engine makes its lists on a GPU (in older "
        "results as of others)",
        "ns");
  FIELD(double, traffic_ns, "buffers.traffic_bytes.mean / memory_gb_per_s", "ns");
  FIELD(std::optional<double>, read_ns,
        "Sum over the sets: samples x divergence x (reads x ns_per_read + read_bytes / read_gb_per_s). Absent in older "
        "results, where reading was free",
        "ns");
  FIELD(double, shade_ns, "Sum over the sets: samples x lights x divergence x ns_per_light", "ns");
  FIELD(std::optional<double>, lights, "Looped over at a sample of these sets, mean", "lights");
  FIELD(std::optional<double>, overshade,
        "Lights given at the samples of these sets / lights that reach them: the overshade that a rank by cost rests "
        "on. null where fewer than 100 reach them, or where one of the sets lacks more than 0.001 of them",
        "ratio");
  FIELD(ByName<SetCost>, sets, "By name, those that are asked for, have a weight and are there");
  FIELD(bool, lit,
        "None of these sets lacks more than 0.001 of the lights that it needs. A case that does is on no front over "
        "cost",
        "", "", Compares::follows);
  END_RECORD;
};

struct Case {
  RECORD(Case);
  FIELD(std::string, id, "Stable over runs and machines: hash of everything that identifies the case");
  FIELD(std::optional<std::string>, settings,
        About("The same but for the contents of the scene's file: stable while a level changes").late());
  FIELD(std::string, name,
        "scene/camera/grid/assigner/storage, then the pre-cull where there is one, and the precision where it is not "
        "float32",
        Compares::skipped);
  FIELD(std::string, scene, "Name of one of scenes", Compares::unjudged);
  FIELD(std::string, camera, "Name in the scene, or of the path that was made because the scene has no camera");
  FIELD(std::optional<CameraPath>, camera_path, "Along which the camera is measured; absent in older results");
  FIELD(Counts2, viewport, "[width, height]", "pixels", "the case");
  FIELD(std::uint64_t, frames, "Frames of the camera's path", "frames", "the case");
  FIELD(Grid, grid, "The grid, with the constants of a shader's lookup");
  FIELD(Method, assigner, "The method that fills the lists");
  FIELD(std::string, storage,
        "What the lists are kept in; own: the assigner leaves a light structure of its own, without lists");
  FIELD(std::optional<bool>, samples_search,
        "true: the case is a light structure that each sample searches for its lights (a hierarchy, masks of bits) in "
        "place of reading a list. What that reads is counted and priced by config.cost, and no GPU has measured it: "
        "such a case stands on no front. Absent: it is none");
  FIELD(std::optional<std::string>, preset,
        "The preset that the case is of (`clusterbench list presets`); absent for the configuration's own clusterings");
  FIELD(std::optional<std::string>, machine,
        "Name of one of machines, where its times and instructions were measured; absent where they are of one "
        "machine, and without any",
        Compares::skipped);
  FIELD(std::vector<Failure>, failures, "Why the case fails the run; empty: it passes", Compares::unjudged);
  FIELD(std::vector<Warning>, warnings, "What to know about the case before believing its figures, beside its failures",
        Compares::follows);
  FIELD(bool, loses_lights,
        "Whether a shader lacks lights: pairs that are not listed or were dropped, lights that samples of a structure "
        "without cells miss, or more than 0.001 of those that visible surfaces need; without samples of surfaces, of "
        "those that random points in the view need",
        Compares::follows);
  FIELD(bool, eligible,
        "Whether it may stand on the Pareto front, and be the best that others are measured by: it fails nothing, "
        "loses no lights (loses_lights), and its method is conservative, exact or of a preset: others can lose lights "
        "in frames that were not measured",
        Compares::follows);
  FIELD(std::uint64_t, tests_done,
        "Over all frames: cells, rows of cells, lights or planes, whichever a method looks at one by one; a method "
        "that looks at many at a time counts otherwise than its scalar reference",
        "tests", "all frames", Compares::cost);
  FIELD(std::uint64_t, fallbacks,
        "Pairs that the method could not decide in single precision and decided at greater cost", "pairs", "all frames",
        Compares::cost);
  FIELD(std::optional<std::uint64_t>, lights,
        About("Lights of the scene that methods get: points, spots, and boxes where the configuration asks for them. "
              "Absent in older results",
              "lights", "the scene")
            .late());
  FIELD(std::optional<std::uint64_t>, lights_lit,
        About("Those of them that shine in some frame: not of intensity 0, black, or of range 0; boxes count as lit. "
              "Dark lights are in lists and all other figures like others. Absent in older results",
              "lights", "all frames")
            .late());
  FIELD(std::optional<std::uint64_t>, lights_seen,
        About("Those of them that are in view (lights_in_view) in a frame in which they shine, each once. Absent in "
              "older results",
              "lights", "all frames")
            .late());
  FIELD(std::optional<LightsInView>, lights_in_view,
        About("Lights of a frame whose bounding sphere (a spot's: around its cone) reaches into the half-spaces of the "
              "camera's six planes, before any pre-cull; the same for all cases of a camera and viewport. What "
              "engines' limits of lights are about. Absent in older results",
              "lights")
            .late());
  FIELD(std::optional<LightsBeyondGrid>, lights_beyond_grid,
        "Lights in view that may reach a point in view which lies in no cell of the grid. 0: samples beyond the cells "
        "lack nothing, however few they are. Absent without cells of the grid and in older results",
        "lights");
  FIELD(std::optional<Occupancy>, occupancy, "How full the grid's cells are; absent without cells");
  FIELD(Buffers, buffers, "What to allocate");
  FIELD(std::optional<std::uint64_t>, cells_not_compared,
        About("Cells of a frame's grid that were not compared with the truth, since there are too many "
              "(config.accuracy.most_pairs): there is no error, a structure of its own has no occupancy, and what "
              "samples lack decides. Absent: they were compared, or it was not asked for",
              "count", "one frame")
            .at_least(1));
  FIELD(std::optional<ListError>, error,
        "Lists against the truth; absent without cells, where it is not asked for, and with cells_not_compared", "",
        "all frames");
  FIELD(std::optional<SampleSet>, shading,
        "What a shader would loop over at points in the whole view, at random pixels and depths", "",
        "the samples of all frames");
  FIELD(std::optional<SampleSets>, samples,
        "What a shader would loop over at sets of points that the configuration asks for, by the set's name; without "
        "sets that the scene has not",
        "", "the set's samples of all frames");
  FIELD(std::optional<DepthRanges>, depth_ranges,
        "How much depth the list of a visible pixel covers, by the kind of list, whatever the case's method is; with "
        "samples.opaque on a frustum grid",
        "", "the visible pixels of all frames");
  FIELD(std::optional<std::vector<Lookup>>, lookup, "A shader's lookup on samples, once per logarithm and depth", "",
        "the samples of all frames", Compares::cost);
  FIELD(std::optional<Stability>, stability,
        "Lists along a piece of the path in fine steps, beside the true lists; where the configuration asks for it");
  FIELD(std::optional<Precision>, precision,
        "How precisely the assigner gets its lights; where the configuration asks for more than float32");
  FIELD(std::optional<PreCull>, pre_cull,
        "What happens to lights before the assigner gets them; absent where it gets all. buffers, tests_done and times "
        "are those of the lights that are left; error, shading and samples are told against all lights, in their "
        "indices");
  FIELD(std::optional<Fit>, fit,
        "Of slices that follow what frames need (slices.fit): what that saves and risks beside the same case in the "
        "same grid without");
  FIELD(std::optional<Reaction>, react,
        "Of tiles that react (react of a grid): how often they did, and what that saves and costs beside the same case "
        "in the tiles that were asked for");
  FIELD(std::optional<Fallback>, fallback,
        "Of a storage whose room can end (packed with max_entries): how often cells read all lights of the frame in "
        "place of their own, and what that saves and costs beside the same case with room for all",
        Compares::cost);
  FIELD(std::optional<Shadows>, shadows,
        "What lies in the shadow of the scene's triangles, and what sharing shadow maps saves; where the configuration "
        "asks for it (shadow_cull, shadow_frusta)");
  FIELD(std::optional<Timing>, timing, "Wall times", Compares::skipped);
  FIELD(
      std::optional<DeviceTimes>, device,
      "Times of a method that runs on a device (a GPU), by the device's own clock. Absent elsewhere, and where nothing "
      "is timed or the device has no clock",
      Compares::skipped);
  FIELD(std::optional<Reading>, reading,
        "What samples pay for their lights on a device (a GPU), by its clock; where the configuration asks for it "
        "(reading). Absent for structures that shaders do not read, and where the device has no clock",
        Compares::skipped);
  FIELD(std::optional<std::string>, unread, "Why there is no reading though the configuration asks for it, as text",
        Compares::skipped);
  FIELD(std::optional<Details>, details, "Chosen frames cell by cell");
  FIELD(std::optional<Count>, count, "Instructions of what is timed, with --count", Compares::skipped);
  FIELD(std::optional<Cost>, cost,
        "What a frame costs with its shading, by the model and the constants of config.cost; where samples of a set "
        "with a weight are asked for",
        "", "one frame, mean over all frames");
  END_RECORD;
};

}  // namespace clusterbench::result
