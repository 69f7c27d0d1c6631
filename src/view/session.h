// Everything the viewer does, without a window: the scene as it was changed, the threads that solve
// and render it, what is to be seen of it, and saving. One thread (the window's) uses it; nothing
// here waits for solving or rendering, but saving.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/yaml_reader.h"
#include "view/picture_thread.h"
#include "view/solve_thread.h"

namespace knotlight {

// A material of the scene file and the objects made of it.
struct NamedMaterial {
  std::string name;
  std::vector<std::uint32_t> objects;  // at least one
};

class ViewSession {
 public:
  // Reads and checks the scene and begins to solve it; errors as of `render`. on_change is called,
  // from other threads, whenever update() may find something new.
  ViewSession(const std::string& path, const RunOptions& options,
              const std::function<void()>& on_change);

  const Scene& scene() const { return scene_; }
  const std::vector<NamedMaterial>& materials() const { return materials_; }
  // Changes the scene (not its camera, and no shapes) and has it solved anew.
  void edit(Change change, const std::function<void(Scene&)>& with);
  const PreviewSettings& preview() const { return preview_; }
  void set_preview(const PreviewSettings& preview);
  // The material of all objects that have it.
  void edit_material(const NamedMaterial& material, const Material& value);

  // The camera with the scene's own resolution.
  const Camera& camera() const { return scene_.camera; }
  void set_camera(const Camera& camera);
  void reset_camera() { set_camera(original_.camera); }
  // Where there is room for the picture, pixels.
  void set_room(int width, int height);
  // The picture in the room: same shape as the scene's.
  Camera picture_camera() const { return fitted(scene_.camera, room_width_, room_height_); }
  void set_layer(const ViewLayer* layer);  // null: the picture itself
  int layer_channel = 0;                   // that is shown of a layer of kind amount

  // To be called often: has newly solved scenes rendered.
  void update();

  std::shared_ptr<const PictureFrame> frame() const { return picture_thread_.frame(); }
  std::uint64_t frames() const { return picture_thread_.frames(); }
  // What is being looked at; null before the first preview is solved.
  const SolvedView* view() const { return view_.get(); }
  SolveThread::Status status() const { return solve_thread_.status(); }
  // The translucent object that the eye is inside of; empty if it is outside.
  std::string eye_inside() const;

  // Samples per pixel at which refinement stops.
  int most_passes() const;
  // The factor for the picture's values: 2^stops times the automatic one, which follows the frames
  // smoothly while `automatic`.
  double exposure() const;
  double exposure_stops = 0.0;
  bool exposure_automatic = true;

  // STEM.exr (linear) and STEM.png (as on the screen) of the newest frame; names the two files.
  // Throws InputError if there is no picture yet or no such folder.
  std::string save_picture(const std::string& stem) const;
  // The scene with all changes and the camera, as YAML. Throws InputError for another extension or
  // if there is no such folder.
  void save_scene(const std::string& file) const;

 private:
  void ask_for_picture(int silent_passes);

  std::string path_;
  RunOptions options_;
  YamlNode document_;
  Scene original_, scene_;
  PreviewSettings preview_;
  std::shared_ptr<const RayCaster> caster_;
  std::vector<NamedMaterial> materials_;
  int room_width_ = 0, room_height_ = 0;
  const ViewLayer* layer_ = nullptr;
  std::shared_ptr<const SolvedView> view_;
  std::uint64_t metered_frames_ = 0;  // frames that automatic_exposure_ has followed
  double automatic_exposure_ = 0.0;   // 0: nothing metered yet
  SolveThread solve_thread_;
  PictureThread picture_thread_;
};

}  // namespace knotlight
