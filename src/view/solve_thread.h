// Solves in the background what the window asks for: first as a preview, then, when nothing has
// changed for a while, with the quality of the scene. A newer wish stops work on an older one.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "view/solved_view.h"

namespace knotlight {

class SolveThread {
 public:
  enum class Activity { idle, preview, waiting, full };
  struct Status {
    Activity activity = Activity::idle;
    double seconds = 0.0;  // of this activity so far
    std::string error;     // why the last wish could not be solved; empty if it could
  };

  // on_change is called, from the thread, whenever latest() or status() has changed.
  SolveThread(const RunOptions& options, std::function<void()> on_change);
  ~SolveThread();
  SolveThread(const SolveThread&) = delete;
  SolveThread& operator=(const SolveThread&) = delete;

  // Never waits. `change`: in what the scene differs from the one given last.
  void request(Scene scene, const PreviewSettings& preview, Change change);

  // The best there is; null before the first preview is ready. It stays while another is made.
  std::shared_ptr<const SolvedView> latest() const;
  Status status() const;
  // Waits until there is nothing left to do, the full quality included. For tests.
  void wait_until_idle() const;

 private:
  struct Wish {
    Scene scene;
    PreviewSettings preview;
    Change change;
  };
  void run();
  void fulfil(const Wish& wish);
  // Whether a solution was published.
  bool attempt(const std::function<std::shared_ptr<const SolvedView>(RunContext&)>& solve);
  bool nothing_new_for(std::chrono::milliseconds time);
  void enter(Activity activity);

  RunOptions options_;
  std::function<void()> on_change_;
  std::unique_ptr<FactorCache> preview_factors_, full_factors_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<Wish> wish_;
  std::optional<Change> unsolved_;  // what wishes that came to nothing had changed
  std::shared_ptr<const SolvedView> latest_;
  Activity activity_ = Activity::idle;
  std::chrono::steady_clock::time_point since_;
  std::string error_;
  bool ends_ = false;
  std::atomic<bool> cancelled_{false};
  std::thread thread_;
};

}  // namespace knotlight
