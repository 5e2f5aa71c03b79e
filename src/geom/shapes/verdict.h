#pragma once

namespace clusterbench::geom {

// Do a light's volume and a cell share a point? Uncertain: left to the next, more precise step; after the last step,
// undecided.
enum class Verdict { no, yes, uncertain };

}  // namespace clusterbench::geom
