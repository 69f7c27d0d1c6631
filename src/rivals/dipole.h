// Subsurface scattering by the dipole, evaluated hierarchically [JMLH01, JB02]: the rival whose
// speed and error stand beside ours. Every piece of the surface is taken for that of a half-space:
// docs/rivals.md.
#pragma once

#include "core/parallel.h"
#include "rivals/dipole_kernel.h"
#include "rivals/irradiance_tree.h"
#include "scene/scene.h"
#include "trace/ray_caster.h"

namespace knotlight {

struct DipoleSettings {
  DipoleForm form = DipoleForm::classic;
  // Places where light enters, per square of a transport mean free path ([JB02] has 1/pi). The
  // noise of M on a plane is about 0.1 / this (docs/rivals.md).
  double samples_per_square = 20.0;
  std::size_t most_samples = 2'000'000;  // per object and channel
  int rays = 4;                          // to the lights from each of them; one if that is exact
  // Of the tree, steradian: IrradianceTree. The errors of the sum are then below 1 % wherever it is
  // above 1 % of the brightest.
  double solid_angle = 0.02;
  // Add light that is scattered once (once_scattered.h) to pictures, as [JMLH01] does. The classic
  // dipole gives back all light that is not absorbed, so that this counts it twice.
  bool single_scattering = false;
};

// Where light enters one object, in one channel.
class DipoleSolution {
 public:
  // Of the lights' light and what diffuse objects reflect of it (trace/direct_light.h). Same bits
  // for any number of workers. caster was built from scene.objects in order. Throws InputError if
  // the object emits light of its own, which the dipole knows nothing of.
  DipoleSolution(const Scene& scene, const RayCaster& caster, std::uint32_t object, int channel,
                 const DipoleSettings& settings, std::uint64_t seed, const Workers& workers);

  // Radiant exitance at N points of the surface (3 x N), W/length^2. Same bits for any number of
  // workers.
  Eigen::VectorXd exitances(const Points& points, const Workers& workers) const;
  // Mean intensity on the surface with this exitance: U_d = A M / (2 pi), W/(length^2 sr).
  Eigen::VectorXd mean_intensities(const Points& points, const Workers& workers) const;

  double A() const { return A_; }  // internal reflection, [H94]
  const IrradianceTree& tree() const { return tree_; }
  const DipoleKernel& kernel() const { return kernel_; }
  // Root of the area per sample, over the transport mean free path. Above 1 the samples are too
  // few for the result to mean anything.
  double spacing() const { return spacing_; }

 private:
  double A_;
  double solid_angle_;
  double spacing_ = 0.0;
  DipoleKernel kernel_;
  IrradianceTree tree_;
};

}  // namespace knotlight
