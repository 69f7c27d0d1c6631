#include "app/view_window.h"

#include <SDL.h>
#include <backends/imgui_impl_sdl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/imgui_canvas.h"
#include "app/view_panel.h"
#include "report/false_colour.h"
#include "view/display.h"
#include "view/orbit.h"
#include "view/session.h"

namespace knotlight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int panel_width = 380;
constexpr int default_picture_height = 720;
constexpr int least_picture_width = 480, most_picture_width = 1100;
constexpr int least_picture_height = 360;
constexpr double frame_pause = 1.0 / 60.0;  // seconds between two drawings of the window at least
constexpr int idle_wait_ms = 250;           // for words that tell the time to stay right
// Dear ImGui lays out over two frames; a third for what the second has opened.
constexpr int drawings_after_event = 3;
constexpr double zoom_per_notch = 0.9;
constexpr float handle_radius = 7.0F;  // of a light that can be dragged, pixels
constexpr float grab_radius = 12.0F;   // in which the mouse takes hold of it

constexpr ImU32 white = IM_COL32(255, 255, 255, 230);
constexpr ImU32 shade = IM_COL32(0, 0, 0, 150);

struct WindowCloser {
  void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
  void operator()(SDL_Renderer* renderer) const { SDL_DestroyRenderer(renderer); }
  void operator()(SDL_Texture* texture) const { SDL_DestroyTexture(texture); }
};
using WindowPointer = std::unique_ptr<SDL_Window, WindowCloser>;
using RendererPointer = std::unique_ptr<SDL_Renderer, WindowCloser>;
using TexturePointer = std::unique_ptr<SDL_Texture, WindowCloser>;

[[noreturn]] void no_window(const std::string& why) {
  throw std::runtime_error(fmt::format("cannot open a window: {}", why));
}

// SDL itself, from the first window to the last.
struct Sdl {
  Sdl() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // Ctrl-C stays ours
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) no_window(SDL_GetError());
  }
  ~Sdl() { SDL_Quit(); }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;
};

void require_display() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"})
    if (const char* value = std::getenv(name); value != nullptr && *value != '\0') return;
  no_window("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
}

// Where the lights are that have a place.
std::optional<Vec3> place_of(const Light& light) {
  if (const auto* point = std::get_if<PointLight>(&light)) return point->position;
  if (const auto* area = std::get_if<AreaLight>(&light)) return area->center;
  return std::nullopt;
}

void move(Light& light, const Vec3& by) {
  if (auto* point = std::get_if<PointLight>(&light)) point->position += by;
  if (auto* area = std::get_if<AreaLight>(&light)) area->center += by;
}

class ViewWindow {
 public:
  ViewWindow(const std::string& path, const RunOptions& options)
      : session_(path, options, [this] { wake(); }) {
    const std::string stem = std::filesystem::path(path).stem().string();
    panel_.picture_name = stem;
    panel_.scene_name = stem + "-view.yaml";
    open(stem);
  }

  void run() {
    auto last_drawn = Clock::now();
    while (!quits_) {
      SDL_Event event;
      if (SDL_WaitEventTimeout(&event, drawings_ > 0 ? 0 : idle_wait_ms) != 0) handle(event);
      const double pause =
          frame_pause - std::chrono::duration<double>(Clock::now() - last_drawn).count();
      if (pause > 0.0) SDL_Delay(static_cast<Uint32>(1e3 * pause) + 1);
      while (SDL_PollEvent(&event) != 0) handle(event);
      last_drawn = Clock::now();
      woken_ = false;
      session_.update();
      draw();
      drawings_ = std::max(0, drawings_ - 1);
    }
  }

 private:
  enum class Drag { none, orbit, pan, light };

  void open(const std::string& title) {
    require_display();
    sdl_.emplace();
    const Camera& camera = session_.camera();
    const int width = std::clamp(default_picture_height * camera.width_px / camera.height_px,
                                 least_picture_width, most_picture_width);
    const int height = std::clamp(width * camera.height_px / camera.width_px, least_picture_height,
                                  default_picture_height);
    window_.reset(SDL_CreateWindow(fmt::format("knotlight - {}", title).c_str(),
                                   SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                   width + panel_width, height, SDL_WINDOW_RESIZABLE));
    if (!window_) no_window(SDL_GetError());
    SDL_SetWindowMinimumSize(window_.get(), panel_width + least_picture_width / 2,
                             least_picture_height);
    renderer_.reset(SDL_CreateRenderer(window_.get(), -1, 0));
    if (!renderer_) no_window(SDL_GetError());
    canvas_.emplace(window_.get(), renderer_.get());
    wake_event_ = SDL_RegisterEvents(1);
  }

  // Called from the session's threads.
  void wake() {
    const Uint32 type = wake_event_;
    if (type == 0 || woken_.exchange(true)) return;
    SDL_Event event{};
    event.type = type;
    SDL_PushEvent(&event);
  }

  // -------------------------------------------------------------- events

  void handle(const SDL_Event& event) {
    if (event.type == wake_event_) {
      drawings_ = std::max(drawings_, 1);
      return;
    }
    drawings_ = drawings_after_event;
    ImGui_ImplSDL2_ProcessEvent(&event);
    switch (event.type) {
      case SDL_QUIT:
        quits_ = true;
        break;
      case SDL_KEYDOWN:
        press(event.key.keysym.sym);
        break;
      case SDL_MOUSEBUTTONDOWN:
        begin_drag(event.button);
        break;
      case SDL_MOUSEBUTTONUP:
        drag_ = Drag::none;
        break;
      case SDL_MOUSEMOTION:
        drag(event.motion.xrel, event.motion.yrel);
        break;
      case SDL_MOUSEWHEEL:
        if (!ImGui::GetIO().WantCaptureMouse)
          session_.set_camera(
              zoomed(session_.camera(), std::pow(zoom_per_notch, event.wheel.preciseY)));
        break;
      default:
        break;
    }
  }

  void press(SDL_Keycode key) {
    if (key == SDLK_F1) panel_.help = !panel_.help;
    if (ImGui::GetIO().WantTextInput) return;
    if (key == SDLK_ESCAPE || key == SDLK_q) quits_ = true;
    if (key == SDLK_SPACE) session_.reset_camera();
    if (key == SDLK_s) save_picture(session_, panel_);
  }

  void begin_drag(const SDL_MouseButtonEvent& button) {
    if (ImGui::GetIO().WantCaptureMouse || button.x >= room_width_) return;
    drag_ = button.button == SDL_BUTTON_LEFT ? Drag::orbit : Drag::pan;
    if (drag_ != Drag::orbit) return;
    for (std::size_t i = 0; i < session_.scene().lights.size(); ++i) {
      const auto handle = handle_of(i);
      if (!handle || std::hypot(handle->x - static_cast<float>(button.x),
                                handle->y - static_cast<float>(button.y)) > grab_radius)
        continue;
      drag_ = Drag::light;
      dragged_light_ = i;
    }
  }

  void drag(int dx, int dy) {
    const double height = picture_.h;
    const double right = dx / height;
    const double down = dy / height;
    switch (drag_) {
      case Drag::none:
        break;
      case Drag::orbit:
        session_.set_camera(orbited(session_.camera(), right, down));
        break;
      case Drag::pan:
        session_.set_camera(panned(session_.camera(), right, down));
        break;
      case Drag::light:
        session_.edit(Change::lights, [&](Scene& scene) {
          Light& light = scene.lights[dragged_light_];
          move(light, shift_in_picture(scene.camera, *place_of(light), right, down));
        });
        break;
    }
  }

  // -------------------------------------------------------------- drawing

  void draw() {
    lay_out();
    upload();
    SDL_SetRenderDrawColor(renderer_.get(), 18, 19, 21, 255);
    SDL_RenderClear(renderer_.get());
    if (texture_) SDL_RenderCopy(renderer_.get(), texture_.get(), nullptr, &picture_);
    canvas_->begin_frame();
    draw_handles();
    draw_bar();
    if (!texture_)
      draw_words("solving ...", 0.5F * static_cast<float>(room_width_), 0.5F * height_);
    draw_panel(session_, panel_, static_cast<float>(room_width_), panel_width, height_);
    draw_warnings(session_, static_cast<float>(room_width_));
    draw_help(panel_, static_cast<float>(room_width_), height_);
    canvas_->end_frame();
    SDL_RenderPresent(renderer_.get());
  }

  void lay_out() {
    int width = 0;
    int height = 0;
    SDL_GetWindowSize(window_.get(), &width, &height);
    room_width_ = std::max(1, width - panel_width);
    height_ = static_cast<float>(height);
    session_.set_room(room_width_, height);
    const Camera camera = session_.picture_camera();
    picture_ = {(room_width_ - camera.width_px) / 2, (height - camera.height_px) / 2,
                camera.width_px, camera.height_px};
  }

  // Brings what is new of the frame, the exposure or the layer into the texture.
  void upload() {
    const auto frame = session_.frame();
    if (!frame) return;
    const double exposure = session_.exposure();
    const int channel = session_.layer_channel;
    if (frame == shown_ && exposure == shown_exposure_ && channel == shown_channel_) return;
    if (frame != shown_) count_frame();
    shown_ = frame;
    shown_exposure_ = exposure;
    shown_channel_ = channel;

    ScreenImage screen;
    if (const ViewLayer* layer = frame->wish.layer) {
      scale_ = layer_scale(frame->image, channel);
      screen = display_bytes(layer_colours(frame->image, *layer, channel, scale_));
    } else {
      screen = tone_mapped_bytes(frame->image, exposure);
    }
    if (!texture_ || texture_width_ != screen.width || texture_height_ != screen.height) {
      texture_width_ = screen.width;
      texture_height_ = screen.height;
      texture_.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_ARGB8888,
                                       SDL_TEXTUREACCESS_STREAMING, screen.width, screen.height));
      if (!texture_) no_window(SDL_GetError());
      SDL_SetTextureScaleMode(texture_.get(), SDL_ScaleModeLinear);
    }
    SDL_UpdateTexture(texture_.get(), nullptr, screen.pixels.data(), 4 * screen.width);
  }

  // The mean over the last frames that followed each other quickly.
  void count_frame() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_frame_).count();
    last_frame_ = now;
    constexpr double pause = 0.5;
    constexpr double newest_weight = 0.2;
    if (seconds > pause || seconds <= 0.0) return;
    double& rate = panel_.frames_per_second;
    rate = rate == 0.0 ? 1.0 / seconds
                       : 1.0 / ((1.0 - newest_weight) / rate + newest_weight * seconds);
  }

  // Where a light is in the window, if it has a place and can be seen.
  std::optional<ImVec2> handle_of(std::size_t light) const {
    const auto place = place_of(session_.scene().lights[light]);
    if (!place) return std::nullopt;
    const auto pixel = projected(session_.picture_camera(), *place);
    if (!pixel) return std::nullopt;
    const ImVec2 handle(static_cast<float>(pixel->x()) + static_cast<float>(picture_.x),
                        static_cast<float>(pixel->y()) + static_cast<float>(picture_.y));
    const bool is_seen = handle.x >= 0.0F && handle.x < static_cast<float>(room_width_) &&
                         handle.y >= 0.0F && handle.y < height_;
    return is_seen ? std::optional(handle) : std::nullopt;
  }

  void draw_handles() {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (std::size_t i = 0; i < session_.scene().lights.size(); ++i) {
      const auto handle = handle_of(i);
      if (!handle) continue;
      list.AddCircleFilled(*handle, handle_radius, shade);
      list.AddCircle(*handle, handle_radius, IM_COL32(255, 200, 120, 255), 0, 2.0F);
      list.AddText(ImVec2(handle->x + handle_radius + 4.0F, handle->y - 8.0F), white,
                   fmt::format("{}", i + 1).c_str());
    }
  }

  void draw_words(const std::string& words, float x, float y) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    ImGui::GetBackgroundDrawList()->AddText(ImVec2(x - 0.5F * size.x, y - 0.5F * size.y), white,
                                            words.c_str());
  }

  // The value of the layer under the mouse, in words; and its colour's place on the bar, 0..1.
  std::string value_at_mouse(float& place) const {
    int x = 0;
    int y = 0;
    SDL_GetMouseState(&x, &y);
    const Image& image = shown_->image;
    const int column = (x - picture_.x) * image.width / picture_.w;
    const int row = (y - picture_.y) * image.height / picture_.h;
    if (x < picture_.x || y < picture_.y || column >= image.width || row >= image.height) return "";
    const Spectrum& value = image.at(column, row);
    place = static_cast<float>((value[shown_channel_] - scale_.low) / (scale_.high - scale_.low));
    return describe_value(*shown_->wish.layer, value, shown_channel_, session_.scene());
  }

  void draw_bar() {
    if (!shown_ || shown_->wish.layer == nullptr) return;
    const ViewLayer& layer = *shown_->wish.layer;
    const bool has_bar = layer.kind == ViewLayer::Kind::amount;
    constexpr float bar_width = 300.0F, bar_height = 14.0F, margin = 12.0F, line = 18.0F;
    constexpr int steps = 60;
    const float box_height = (has_bar ? bar_height + 2.0F * line + 6.0F : line) + 2.0F * margin;
    const ImVec2 box(16.0F, height_ - box_height - 16.0F);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled(box, ImVec2(box.x + bar_width + 2.0F * margin, box.y + box_height),
                       IM_COL32(20, 21, 24, 220), 6.0F);
    float place = -1.0F;
    const std::string value = value_at_mouse(place);
    const std::string unit = layer.unit(session_.scene().units);
    std::string title = unit.empty() ? layer.name : fmt::format("{}, {}", layer.name, unit);
    if (!value.empty()) title = fmt::format("{}: {}", layer.name, value);
    const ImVec2 corner(box.x + margin, box.y + margin);
    list.AddText(corner, white, title.c_str());
    if (!has_bar) return;
    const float top = corner.y + line + 4.0F;
    for (int i = 0; i < steps; ++i) {
      const Spectrum c = 255.0 * map_colour(ColourMap::sequential, (i + 0.5) / steps);
      const float x = corner.x + static_cast<float>(i) * bar_width / steps;
      list.AddRectFilled(
          ImVec2(x, top), ImVec2(x + bar_width / steps, top + bar_height),
          IM_COL32(static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), 255));
    }
    const float bottom = top + bar_height + 2.0F;
    const auto tick = [&](float share, double number) {
      const std::string words = fmt::format("{:.3g}", number);
      const float width = ImGui::CalcTextSize(words.c_str()).x;
      list.AddText(ImVec2(corner.x + share * (bar_width - width), bottom), white, words.c_str());
    };
    tick(0.0F, scale_.low);
    tick(0.5F, 0.5 * (scale_.low + scale_.high));
    tick(1.0F, scale_.high);
    if (!value.empty()) {
      const float x = corner.x + std::clamp(place, 0.0F, 1.0F) * bar_width;
      list.AddRectFilled(ImVec2(x - 1.5F, top - 3.0F), ImVec2(x + 1.5F, top + bar_height + 3.0F),
                         white);
    }
  }

  std::atomic<Uint32> wake_event_{0};  // 0: there is no window yet
  std::atomic<bool> woken_{false};     // an event that wakes the window is under way
  PanelState panel_;
  bool quits_ = false;
  int drawings_ = drawings_after_event;  // still to do, even if nothing happens
  Drag drag_ = Drag::none;
  std::size_t dragged_light_ = 0;
  int room_width_ = 1;
  float height_ = 1.0F;
  SDL_Rect picture_{0, 0, 1, 1};  // in the window

  std::shared_ptr<const PictureFrame> shown_;  // in the texture
  double shown_exposure_ = 0.0;
  int shown_channel_ = 0;
  LayerScale scale_;
  int texture_width_ = 0, texture_height_ = 0;
  Clock::time_point last_frame_;

  std::optional<Sdl> sdl_;
  WindowPointer window_;
  RendererPointer renderer_;
  std::optional<ImGuiCanvas> canvas_;
  TexturePointer texture_;
  ViewSession session_;  // its threads end first
};

}  // namespace

void view_scene(const std::string& path, const RunOptions& options) {
  ViewWindow(path, options).run();
}

}  // namespace knotlight
