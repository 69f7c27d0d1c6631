#include "view/picture_thread.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/clock.h"
#include "view/priority.h"

namespace knotlight {
namespace {

constexpr std::array<int, 8> strides = {1, 2, 3, 4, 6, 8, 12, 16};
// For the first picture after a change: 30 frames a second, with something left for the window.
constexpr double frame_seconds = 0.025;
// Assumed before anything was measured: slow, so that the first frame is coarse at worst.
constexpr double unknown_seconds_per_ray = 1e-6;

RaySample ray_sample(const PictureWish& wish, const Look& look) {
  if (wish.layer != nullptr)
    return [&look, &wish](const Ray& ray, Rng& rng) {
      return layer_value(*wish.layer, *wish.view->prepared, *look.shading, ray, rng);
    };
  return [&look](const Ray& ray, Rng& rng) { return look.shading->radiance(ray, rng); };
}

}  // namespace

int stride_within(double seconds, double seconds_per_ray, int width, int height) {
  const double full = seconds_per_ray * width * height;
  for (const int stride : strides)
    if (full <= seconds * stride * stride) return stride;
  return strides.back();
}

PictureThread::PictureThread(std::uint64_t seed, int threads, std::function<void()> on_frame)
    : seed_(seed),
      threads_(threads),
      on_frame_(std::move(on_frame)),
      seconds_per_ray_(unknown_seconds_per_ray),
      thread_([this] { run(); }) {}

PictureThread::~PictureThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    cancelled_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PictureThread::show(PictureWish wish) {
  {
    const std::lock_guard lock(mutex_);
    wish_ = std::move(wish);
    cancelled_ = true;
  }
  changed_.notify_all();
}

std::shared_ptr<const PictureFrame> PictureThread::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

void PictureThread::run() {
  set_niceness(niceness_of_picture);
  while (true) {
    PictureWish wish;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return wish_ || ends_; });
      if (ends_) return;
      wish = std::move(*wish_);
      wish_.reset();
      cancelled_ = false;
    }
    try {
      refine(wish);
    } catch (const Cancelled&) {
      continue;  // a newer wish is waiting
    }
  }
}

void PictureThread::refine(const PictureWish& wish) {
  const Workers workers(threads_, &cancelled_);
  if (wish.silent_passes == 0) {
    const Look& quick = wish.layer != nullptr ? wish.view->look : wish.view->look_in_motion();
    const RaySample sample = ray_sample(wish, quick);
    // Where the quick look is another, it fills the time to the first fine picture.
    const int finest = &quick == &wish.view->look ? 2 : 1;
    int stride =
        stride_within(frame_seconds, seconds_per_ray_, wish.camera.width_px, wish.camera.height_px);
    // Finished whatever happens: a camera that never rests is to be seen moving.
    show_coarse(wish, sample, stride, Workers(threads_));
    while ((stride /= 2) >= finest) show_coarse(wish, sample, stride, workers);
  }
  const RaySample sample = ray_sample(wish, wish.view->look);
  Accumulation picture(wish.camera, seed_);
  const int passes = wish.layer != nullptr && !wish.layer->by_chance ? 1 : wish.most_passes;
  while (picture.passes() < passes) {
    picture.add_pass(sample, workers);
    if (picture.passes() >= std::min(wish.silent_passes, passes)) publish(wish, picture, 1);
  }
}

void PictureThread::show_coarse(const PictureWish& wish, const RaySample& sample, int stride,
                                const Workers& workers) {
  const Camera camera = coarse(wish.camera, stride);
  Accumulation picture(camera, seed_);
  const auto start = Clock::now();
  picture.add_pass(sample, workers);
  seconds_per_ray_ = seconds_since(start) / camera.width_px / camera.height_px;
  publish(wish, picture, stride);
}

void PictureThread::publish(const PictureWish& wish, const Accumulation& picture, int stride) {
  auto frame = std::make_shared<const PictureFrame>(
      PictureFrame{wish, picture.mean(), stride, picture.passes()});
  {
    const std::lock_guard lock(mutex_);
    frame_ = std::move(frame);
    ++frames_;
  }
  on_frame_();
}

}  // namespace knotlight
