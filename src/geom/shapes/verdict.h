#pragma once

namespace clusterbench::geom {

// Do a light's volume and a cell share a point?
enum class Verdict { no, yes, open };

}  // namespace clusterbench::geom
