// A camera moved by hand: turned about the point it looks at, brought nearer, shifted; and where
// points of the scene appear in its picture. The camera's `up` is the axis it turns about and never
// changes.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace knotlight {

// Turns the camera about `to`: right and down are the mouse's way in picture heights, and one
// height is half a turn. What the mouse holds follows it. Stays clear of the axis.
Camera orbited(const Camera& camera, double right, double down);

// Brings the camera nearer to `to` (perspective) or narrows the picture (orthographic) by a factor,
// > 0: below 1 the picture grows.
Camera zoomed(const Camera& camera, double factor);

// Shifts the camera and `to` in the plane of the picture, so that what lies as far away as `to`
// follows the mouse; right and down in picture heights.
Camera panned(const Camera& camera, double right, double down);

// Length in the scene of one picture height at the point's distance from the camera.
double picture_height_at(const Camera& camera, const Vec3& point);

// The vector in the plane of the picture that moves a point at `point` by so many picture heights.
Vec3 shift_in_picture(const Camera& camera, const Vec3& point, double right, double down);

// Where the point appears, in pixels, (0, 0) = top left corner of the picture; nothing if it lies
// behind the camera.
std::optional<Eigen::Vector2d> projected(const Camera& camera, const Vec3& point);

}  // namespace knotlight
