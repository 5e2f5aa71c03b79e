#pragma once
// What samples pay for their lights on a device.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct WalkReading {
  RECORD(WalkReading);
  FIELD(std::string, walk,
        About("How the samples of a wave walk their lights. lane: each its own list, until the longest is done. light: "
              "all together, light by light. cell: all together, cell by cell")
            .one_of({"lane", "light", "cell"}));
  FIELD(Time, read_ns,
        "Per frame: each sample looks up its list, walks its lights, adds a small attenuation for each and writes the "
        "sum; the same samples again and again, so that caches hold what fits");
  FIELD(Time, cold_ns, "Per frame: the same once, after other memory went through the caches");
  FIELD(std::optional<Time>, exact_ns,
        "Per frame: read_ns of the lists that `exact` names. Absent where cells are not compared "
        "with the truth");
  FIELD(std::optional<double>, exact_ratio, "read_ns by exact_ns: median of the rounds' ratios", "ratio", "the rounds");
  FIELD(std::optional<Interval>, exact_ci95, "95 % interval of exact_ratio", "ratio", "the rounds");
  FIELD(double, nothing_ratio, "read_ns by nothing_ns: median of the rounds' ratios", "ratio", "the rounds");
  END_RECORD;
};

struct SetReading {
  RECORD(SetReading);
  FIELD(std::string, set,
        About("Whose samples read, as in samples (volume: random points in the whole view)")
            .one_of({"volume", "opaque", "transparent", "fog", "mirror", "anywhere"}));
  FIELD(double, samples, About("Samples per frame, mean", "samples", "the frames that are read").finite().at_least(0));
  FIELD(double, lights, About("Lights that a sample walks, mean", "lights", "the samples").finite().at_least(0));
  FIELD(std::optional<double>, exact_lights, "Lights that a sample walks in the exact lists, mean; absent without them",
        "lights", "the samples");
  FIELD(double, reads,
        About("Elements of the light structure that a sample fetches, mean", "elements", "the samples")
            .finite()
            .at_least(0));
  FIELD(double, read_bytes, About("Their bytes, mean", "B", "the samples").finite().at_least(0));
  FIELD(double, divergence,
        About("Of as many invocations as the device's waves have: the sum of their longest lists by that of their mean "
              "ones, weighted by lights over the frames. Idle lanes and steps that walk no light are left out",
              "ratio", "the waves")
            .finite()
            .at_least(1));
  FIELD(
      std::uint64_t, differing,
      "Walks of samples, here and in the exact lists, that met other lights than the structure has, and samples whose "
      "cell the device finds farther off than rounding explains. Other than 0: a fault of the driver or of this "
      "program, and the times are not to be trusted",
      "walks and samples", "the frames that are read");
  FIELD(Time, write_ns, "Per frame: each sample writes a word, and reads nothing at all");
  FIELD(
      Time, nothing_ns,
      "Per frame: each sample looks up its cell and writes a word made of it, and reads no list. Where samples look up "
      "no cell (a hierarchy) it is that of its position");
  FIELD(std::vector<WalkReading>, walks, "In the order of the configuration");
  END_RECORD;
};

struct ExactLists {
  RECORD(ExactLists);
  FIELD(std::string, storage, "In which they are kept");
  FIELD(double, bytes, "Of this structure, mean", "B", "the frames that are read");
  END_RECORD;
};

struct Reading {
  RECORD(Reading);
  FIELD(std::string, device, "Name and driver of the device; times of one device alone compare");
  FIELD(bool, software,
        "true: the device computes on the processor: its times are no GPU's, and nothing ranks by them");
  FIELD(std::uint64_t, frames, "Evenly spaced over the path; all times are means over them", "frames", "the path");
  FIELD(double, structure_bytes, "Of the light structure, mean", "B", "the frames that are read");
  FIELD(std::optional<ExactLists>, exact,
        "The lists of exact_ns: the case's storage filled with exact lists of all lights; `packed` beside a structure "
        "of a "
        "method's own. Absent where cells are not compared with the truth");
  FIELD(std::optional<double>, frame_ns,
        "(1 - config.reading.async) x assignment + upload + reading (the one of set and walk), each a median over its "
        "own "
        "frames: reading.frames, timing.frames, and all for uploads of the processor. A method on the device: "
        "device.run_ns + device.upload_ns; another: timing.frame_ns and buffers.upload_bytes by cost.upload_gb_per_s, "
        "and only where config.reading.async is given. Absent where a part of the pixels is read "
        "(config.reading.divisor), and where the host has put lists of the device into another storage. Assignments "
        "are cold where timing.cold asks for it, readings warm. Builds for a changed grid and the picture of depths "
        "are in none",
        "ns", "one frame");
  FIELD(std::string, set, "Its samples are those of the figures and of frame_ns: the configuration's first");
  FIELD(std::string, walk,
        "Likewise; a structure without cells cannot be walked cell by cell, and then has no figures");
  FIELD(std::vector<SetReading>, sets, "In the order of the configuration, those that the scene has");
  END_RECORD;
};

}  // namespace clusterbench::result
