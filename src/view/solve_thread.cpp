#include "view/solve_thread.h"

#include <algorithm>
#include <utility>

#include "pipeline/glow.h"
#include "view/priority.h"

namespace knotlight {
namespace {

using Clock = std::chrono::steady_clock;

// A hand that pauses on a slider moves on within this time.
constexpr std::chrono::milliseconds rest_before_full{600};
// So that turning the preview meanwhile stays smooth.
void run_in_patient_thread(const std::function<void()>& work) {
  std::thread thread([&] {
    set_niceness(niceness_of_full_solve);
    work();
  });
  thread.join();
}

}  // namespace

SolveThread::SolveThread(const RunOptions& options, std::function<void()> on_change)
    : options_(options),
      on_change_(std::move(on_change)),
      preview_factors_(std::make_unique<FactorCache>()),
      full_factors_(std::make_unique<FactorCache>()),
      since_(Clock::now()),
      thread_([this] { run(); }) {}

SolveThread::~SolveThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    cancelled_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void SolveThread::request(Scene scene, const PreviewSettings& preview, Change change) {
  {
    const std::lock_guard lock(mutex_);
    if (wish_) change = std::max(change, wish_->change);
    if (unsolved_) change = std::max(change, *unsolved_);
    unsolved_.reset();
    wish_ = Wish{std::move(scene), preview, change};
    // A preview is let finish: a hand that never rests would otherwise see nothing.
    if (activity_ == Activity::full) cancelled_ = true;
    if (activity_ == Activity::idle) {  // not idle any more, for wait_until_idle
      activity_ = Activity::preview;
      since_ = Clock::now();
    }
  }
  changed_.notify_all();
}

std::shared_ptr<const SolvedView> SolveThread::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

SolveThread::Status SolveThread::status() const {
  const std::lock_guard lock(mutex_);
  return {activity_, std::chrono::duration<double>(Clock::now() - since_).count(), error_};
}

void SolveThread::wait_until_idle() const {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return activity_ == Activity::idle && !wish_; });
}

void SolveThread::run() {
  set_niceness(niceness_of_picture);
  while (true) {
    Wish wish;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return wish_ || ends_; });
      if (ends_) return;
      wish = std::move(*wish_);
      wish_.reset();
      cancelled_ = false;
    }
    fulfil(wish);
    bool more = false;
    {
      const std::lock_guard lock(mutex_);
      more = wish_.has_value();
    }
    if (!more) enter(Activity::idle);
  }
}

void SolveThread::fulfil(const Wish& wish) {
  if (wish.change == Change::materials) {
    preview_factors_ = std::make_unique<FactorCache>();
    full_factors_ = std::make_unique<FactorCache>();
  }
  enter(Activity::preview);
  const std::shared_ptr<const SolvedView> before = latest();
  // Gathered pictures solve another equation than the others (choose_for_picture).
  SolverSettings wanted = wish.scene.solver;
  choose_for_picture(wanted);
  const bool field_stays = wish.change == Change::exitance && before &&
                           wanted.diffusion == before->solved_scene->scene.solver.diffusion;
  const bool shown = attempt([&](RunContext& run) {
    if (field_stays) return with_exitance(*before, wish.scene, run);
    Scene scene = wish.scene;
    scene.solver = preview_of(wish.scene.solver, wish.preview);
    return solve_view(std::move(scene), Quality::preview, run, *preview_factors_);
  });
  if (!shown) {
    const std::lock_guard lock(mutex_);
    if (wish_)
      wish_->change = std::max(wish_->change, wish.change);
    else
      unsolved_ = wish.change;
    return;
  }
  if (latest()->quality == Quality::full) return;
  enter(Activity::waiting);
  if (!nothing_new_for(rest_before_full)) return;
  enter(Activity::full);
  run_in_patient_thread([&] {
    attempt([&](RunContext& run) {
      return solve_view(wish.scene, Quality::full, run, *full_factors_);
    });
  });
}

bool SolveThread::attempt(
    const std::function<std::shared_ptr<const SolvedView>(RunContext&)>& solve) {
  RunContext run(options_, false);
  run.workers = Workers(options_.threads, &cancelled_);
  std::shared_ptr<const SolvedView> view;
  std::string error;
  try {
    view = solve(run);
  } catch (const Cancelled&) {
    return false;
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  {
    const std::lock_guard lock(mutex_);
    if (view) latest_ = view;
    error_ = error;
  }
  on_change_();
  return view != nullptr;
}

bool SolveThread::nothing_new_for(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, time, [&] { return wish_ || ends_; });
}

void SolveThread::enter(Activity activity) {
  {
    const std::lock_guard lock(mutex_);
    activity_ = activity;
    since_ = Clock::now();
  }
  changed_.notify_all();
  on_change_();
}

}  // namespace knotlight
