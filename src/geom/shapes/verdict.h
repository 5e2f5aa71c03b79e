#pragma once

namespace clusterbench::geom {

// Do a light's volume and a cell share a point? Uncertain: the next, more precise step has to decide; after the last
// step it means undecided.
enum class Verdict { no, yes, uncertain };

}  // namespace clusterbench::geom
