// Renders in the background what the window wants to show: a coarse picture within a frame's time
// after every change, then finer ones, then more and more samples per pixel.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "view/accumulation.h"
#include "view/layers.h"
#include "view/solved_view.h"

namespace knotlight {

// What is to be seen.
struct PictureWish {
  std::shared_ptr<const SolvedView> view;
  Camera camera;                     // its resolution is that of the finest picture
  const ViewLayer* layer = nullptr;  // null: the picture itself
  int most_passes = 1;               // samples per pixel after which it is left at that
  // 0: a coarse picture at once; else what was shown before stays until there are so many samples
  // per pixel.
  int silent_passes = 0;
};

struct PictureFrame {
  PictureWish wish;  // what it shows
  Image image;       // linear radiance, or values of the layer
  int stride = 1;    // pixels of the finest picture per pixel, along each side
  int passes = 0;    // samples per pixel
};

class PictureThread {
 public:
  // on_frame is called, from the thread, whenever there is a new frame.
  PictureThread(std::uint64_t seed, int threads, std::function<void()> on_frame);
  ~PictureThread();
  PictureThread(const PictureThread&) = delete;
  PictureThread& operator=(const PictureThread&) = delete;

  // Never waits.
  void show(PictureWish wish);
  // The newest; null before the first.
  std::shared_ptr<const PictureFrame> frame() const;
  std::uint64_t frames() const { return frames_; }  // made so far

 private:
  void run();
  void refine(const PictureWish& wish);
  void show_coarse(const PictureWish& wish, const RaySample& sample, int stride,
                   const Workers& workers);
  void publish(const PictureWish& wish, const Accumulation& picture, int stride);

  std::uint64_t seed_;
  int threads_;
  std::function<void()> on_frame_;
  double seconds_per_ray_;  // as last measured

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<PictureWish> wish_;
  std::shared_ptr<const PictureFrame> frame_;
  std::atomic<std::uint64_t> frames_{0};
  bool ends_ = false;
  std::atomic<bool> cancelled_{false};  // a newer wish is there
  std::thread thread_;
};

// The finest stride (1, 2, 3, 4, 6, 8, 12 or 16) whose picture of width x height / stride^2 rays
// takes at most so many seconds; the coarsest if none does.
int stride_within(double seconds, double seconds_per_ray, int width, int height);

}  // namespace knotlight
