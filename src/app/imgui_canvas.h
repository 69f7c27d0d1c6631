// Dear ImGui drawn by SDL's own renderer, which works with and without a graphics card. (Debian's
// library of Dear ImGui has the part for SDL's events, but not this one.)
#pragma once

#include <SDL.h>

namespace knotlight {

class ImGuiCanvas {
 public:
  // Makes Dear ImGui's context and fonts for the window. Throws std::runtime_error.
  ImGuiCanvas(SDL_Window* window, SDL_Renderer* renderer);
  ~ImGuiCanvas();
  ImGuiCanvas(const ImGuiCanvas&) = delete;
  ImGuiCanvas& operator=(const ImGuiCanvas&) = delete;

  void begin_frame();
  // Draws what was laid out since begin_frame over what the renderer has.
  void end_frame();

 private:
  SDL_Renderer* renderer_;
  SDL_Texture* font_ = nullptr;
};

}  // namespace knotlight
