#include "geom/ball/pyramid_view.h"

#include "geom/ball/pyramid_view_from.h"

namespace clusterbench::geom {

Bounded farthest_ahead(const Point3<Bounded>& direction, const ShellCell& tile) {
  return view_from(direction.x, direction.y, -direction.z, pyramid_of(tile)).along;
}

Point3<Bounded> foot_on_pyramid(const Point3<Bounded>& point, const ShellCell& tile) {
  const PyramidSlab pyramid = pyramid_of(tile);
  const NearestDepth nearest = nearest_between(point.x, point.y, -point.z, pyramid);
  return point + way_to(nearest, point.x, point.y, -point.z, pyramid);
}

}  // namespace clusterbench::geom
