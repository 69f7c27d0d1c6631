// An octree over a body whose leaves are the patches of the localized boundary knot method: small
// where the solver asked for it, and split where a leaf would hold parts of the body that do not
// hang together.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "core/vec3.h"

namespace knotlight {

// Points on the surface, with outward unit normals, 3 x K each, evenly spread; also every long
// enough prefix must be so. They say where the surface is; the boundary knots are taken from them.
struct SpreadKnots {
  Points positions;
  Points normals;
  double area = 0.0;  // of the surface, length^2
};

// The two questions asked about the body. Must be safe to call from several threads.
struct BodyQueries {
  std::function<bool(const Vec3&)> inside;
  // Whether nothing of the surface lies between two points inside.
  std::function<bool(const Vec3&, const Vec3&)> connected;
  // From a point on the surface along the unit vector inwards: distance to the surface met next.
  std::function<double(const Vec3&, const Vec3&)> thickness;
};

// A part of the body: what of a cube, widened by the overlap, hangs together.
struct Patch {
  Vec3 center = Vec3::Zero();       // of the points below, not of the cube
  double radius = 0.0;              // of the ball about center that holds them
  std::vector<Eigen::Index> knots;  // on the surface: indices of SpreadKnots
  double knot_area = 0.0;           // surface area for which each of them stands
  std::vector<Vec3> joints;         // on the widened cube, inside the body
  double joint_area = 0.0;          // of the cube's surface, each
  std::vector<Vec3> hubs;           // inside; from one of them each point can be seen
  std::size_t leaf = 0;             // to which it belongs
};

struct PatchTreeOptions {
  double coarsest_per_size = 6.0;  // leaves along the body's longest side, at least
  // Edges of leaves, length: next to the surface, and anywhere.
  double widest_at_surface = std::numeric_limits<double>::infinity();
  double widest = std::numeric_limits<double>::infinity();
  double overlap = 0.25;              // each side is widened by this part of the leaf's edge
  int joints_per_edge = 4;            // squared: on each side of the widened cube
  std::size_t most_knots = 60;        // per patch
  std::size_t most_patches = 12'000;  // leaves with several parts are split no further beyond
  int deepest = 9;                    // levels below the root: edges of 1/512 of the body's size
};

class PatchTree {
 public:
  // Splits until no leaf is wider than the options say.
  PatchTree(std::shared_ptr<const SpreadKnots> knots, const PatchTreeOptions& options);

  struct Leaf {
    Vec3 center;
    double half = 0.0;  // of its edge
    int level = 0;
    std::vector<Eigen::Index> knots;  // within
    std::vector<std::size_t> patches;
    int first_child = -1;  // of eight, in `nodes`; -1: a leaf
  };

  void split(std::size_t leaf);
  // Makes the patches of all leaves anew. Leaves with more than one part are split first, down to
  // options.deepest.
  void make_patches(const BodyQueries& body, const Workers& workers);

  const SpreadKnots& knots() const { return *surface_; }
  const std::vector<Patch>& patches() const { return patches_; }
  bool can_split(std::size_t leaf) const { return nodes_[leaf].level < options_.deepest; }
  // The patch that x, in or on the body, belongs to; body is asked only where a leaf has several.
  // -1: there are none at all.
  std::ptrdiff_t owner(const Vec3& x, const BodyQueries& body) const;

 private:
  // Points inside, from which what hangs together is found.
  struct PatchSamples {
    std::vector<Vec3> points;
    std::vector<char> in_leaf;  // whether each stands for the leaf itself, not for the overlap
    std::size_t joints_begin = 0, joints_end = 0;  // before them: one for each knot
  };
  PatchSamples sample(const Patch& whole, const Leaf& leaf, const BodyQueries& body) const;
  std::vector<Patch> parts(std::size_t leaf, const BodyQueries& body) const;
  bool touches(std::size_t node, const Vec3& center, double half) const;
  void gather(std::size_t node, const Vec3& center, double half,
              std::vector<Eigen::Index>& found) const;
  std::size_t leaf_at(const Vec3& x) const;

  PatchTreeOptions options_;
  std::vector<Leaf> nodes_;
  std::vector<Patch> patches_;
  std::shared_ptr<const SpreadKnots> surface_;
};

}  // namespace knotlight
