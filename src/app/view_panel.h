// The panel at the side of the viewer's window: what is known about the picture, and everything
// that can be changed about the scene.
#pragma once

#include <string>

#include "view/session.h"

namespace knotlight {

struct PanelState {
  std::string picture_name;  // without extension
  std::string scene_name;
  bool picture_wanted = false;  // to be saved when it is there
  std::string message;          // of the last saving
  bool message_is_error = false;
  bool help = false;  // the list of keys is open
  int layer = 0;      // 0: the picture; else 1 + index into view_layers()
  double frames_per_second = 0.0;
};

// Lays out the panel as Dear ImGui wants it, at x, over the height of the window.
void draw_panel(ViewSession& session, PanelState& state, float x, float width, float height);
// Over the picture, so that nothing in the panel moves under the mouse when they come and go.
void draw_warnings(const ViewSession& session, float picture_width);
void draw_help(PanelState& state, float picture_width, float height);

// What the keys do too. Errors become the panel's message. A picture that is still coarse is saved
// when it is no longer.
void save_picture(const ViewSession& session, PanelState& state);
void save_scene(const ViewSession& session, PanelState& state);

}  // namespace knotlight
