#pragma once
// Pairs in shadow, and shadow maps that spots share.

#include "result/shared_parts.h"

namespace clusterbench::result {

struct ShadowCullSamples {
  RECORD(ShadowCullSamples);
  FIELD(std::uint64_t, samples, "Number of samples", "samples", "all frames");
  FIELD(BeforeAfter, evaluated, "Lights in the lists of their cells", "lights");
  FIELD(std::uint64_t, needed, "Of those before, lights whose volume holds the sample", "lights");
  FIELD(std::uint64_t, lit,
        "Of the needed, those that a ray from the light to the sample finds unobstructed: what the best of all shadow "
        "culls would keep",
        "lights");
  FIELD(std::uint64_t, wrongly_removed, "Of the lit, those that were taken out", "lights", Compares::cost);
  FIELD(double, lost_irradiance, "Share of the lit lights' irradiance that is lost with them", "share of 1",
        Compares::cost);
  END_RECORD;
};

struct ShadowMaps {
  static About about() { return About("", Compares::follows); }
  RECORD(ShadowMaps);
  FIELD(std::uint64_t, lights, "Lights with a map", "lights");
  FIELD(std::uint64_t, made, "Maps that were made", "maps");
  FIELD(std::uint64_t, faces, "Of those", "faces");
  FIELD(std::uint64_t, texels, "Of those, texels into which light goes", "texels");
  FIELD(std::uint64_t, unlimited,
        "Of those, texels without a distance: a ray meets nothing, or (proven) a gap may be left", "texels",
        Compares::cost);
  FIELD(std::uint64_t, bytes, "One map for each light, with all levels of its pyramid, as 32-bit floats", "bytes");
  END_RECORD;
};

struct ShadowCull {
  static About about() { return About("", "", "all frames"); }
  RECORD(ShadowCull);
  FIELD(std::uint64_t, resolution,
        About("Texels along each side of a light's shadow map", "texels", "the case").at_least(1));
  FIELD(std::string, texels,
        About("How a texel's distance was found. proven: triangles were shown to cover it; sampled: the greatest at "
              "its four corners")
            .one_of({"proven", "sampled"}));
  FIELD(double, bias_m, About("So far beyond a surface a point may lie and still be lit", "m", "the case").finite());
  FIELD(double, near_m, About("Surfaces nearer to a light cast no shadow", "m", "the case").finite());
  FIELD(bool, conservative,
        "true: no pair that is lit is taken out, but through gaps and along edges narrower than a millionth of the "
        "distance. false: a map of samples bounds nothing between them; what was lost is counted at samples alone");
  FIELD(BeforeAfter, pairs, "In lists", "pairs");
  FIELD(std::optional<BeforeAfter>, true_pairs,
        "Of those, the true ones: cell and volume share a point; absent without accuracy.check", "pairs");
  FIELD(std::optional<ShadowCullSamples>, opaque, "At visible surfaces in cells of the grid; with samples.opaque", "",
        "the samples of all frames");
  FIELD(ShadowMaps, maps,
        "Shadow maps of the lights in these lists, made when a light is first in one and again when it or a surface "
        "has moved",
        "", "the path");
  END_RECORD;
};

struct GrowthOfVolume {
  RECORD(GrowthOfVolume);
  FIELD(MeanMax, over_largest, "Over that of the largest of its members' own frusta; null without shared ones");
  FIELD(MeanMax, over_sum, "Over the sum of its members' own");
  END_RECORD;
};

struct GrowthOfAngle {
  RECORD(GrowthOfAngle);
  FIELD(MeanMax, over_largest, "Over that of the widest of its members' own frusta; null without shared ones");
  FIELD(MeanMax, over_sum, "Over the sum of its members' own");
  END_RECORD;
};

struct SharedFrusta {
  RECORD(SharedFrusta);
  FIELD(double, apart_m, About("Largest distance between two lights of a group", "m", "the case").finite());
  FIELD(double, turned_deg, About("Largest angle between two axes of a group", "degrees", "the case").finite());
  FIELD(double, growth,
        About("Largest volume of a group's frustum, over that of its largest member's own", "ratio", "the case")
            .finite());
  FIELD(MeanMax, points, "Points whose sphere may be in view; they share nothing", "lights");
  FIELD(MeanMax, spots, "Spots whose bounding sphere may be in view: maps if none is shared", "lights");
  FIELD(MeanMax, maps, "Maps of these spots if they share", "maps");
  FIELD(MeanMax, shared, "Of the maps, those with more than one spot", "maps");
  FIELD(double, saved, "Share of the spots' maps that sharing saves, over all frames; null without spots in view",
        "share of 1");
  FIELD(std::uint64_t, most_members, "Most spots in one map", "lights");
  FIELD(GrowthOfVolume, volume, "Of a shared frustum", "ratio", "shared frusta of all frames");
  FIELD(GrowthOfAngle, solid_angle, "Of a shared frustum", "ratio", "shared frusta of all frames");
  END_RECORD;
};

struct Shadows {
  RECORD(Shadows);
  FIELD(std::optional<std::vector<ShadowCull>>, culls,
        About("Pairs whose cell lies wholly in the light's shadow, taken out of the method's lists (not of its own "
              "structure, where it leaves one): once for each resolution and kind of texels. All other figures of the "
              "case are those of the lists before")
            .items(1, 0));
  FIELD(std::optional<SharedFrusta>, frusta,
        "Shadow maps that spots in view could share, whatever the case's method and grid are: groups of spots in one "
        "square frustum that holds them all",
        "", "frames");
  END_RECORD;
};

}  // namespace clusterbench::result
