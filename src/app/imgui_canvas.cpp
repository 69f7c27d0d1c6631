#include "app/imgui_canvas.h"

#include <backends/imgui_impl_sdl.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace knotlight {
namespace {

constexpr float font_pixels = 15.0F;
constexpr float builtin_font_pixels = 13.0F;  // drawn for this size
// Debian's fonts-dejavu-core.
constexpr const char* font_file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

void load_font() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  if (std::filesystem::exists(font_file)) {
    ImFontGlyphRangesBuilder glyphs;
    glyphs.AddRanges(fonts.GetGlyphRangesDefault());
    static ImVector<ImWchar> ranges;  // looked at as long as the fonts live
    ranges.clear();
    glyphs.BuildRanges(&ranges);
    fonts.AddFontFromFileTTF(font_file, font_pixels, nullptr, ranges.Data);
    return;
  }
  ImFontConfig config;
  config.SizePixels = builtin_font_pixels;
  fonts.AddFontDefault(&config);
}

void set_style() {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowPadding = ImVec2(14, 12);
  style.FramePadding = ImVec2(8, 4);
  style.ItemSpacing = ImVec2(8, 6);
  style.ItemInnerSpacing = ImVec2(6, 4);
  style.IndentSpacing = 12;
  style.ScrollbarSize = 12;
  style.WindowRounding = 0;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.PopupRounding = 4;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  const ImVec4 amber(0.85F, 0.58F, 0.25F, 1.0F);  // wax with a light behind it
  const auto faint = [&](float alpha) { return ImVec4(amber.x, amber.y, amber.z, alpha); };
  ImVec4* colours = style.Colors;
  colours[ImGuiCol_WindowBg] = ImVec4(0.11F, 0.115F, 0.13F, 1.0F);
  colours[ImGuiCol_PopupBg] = ImVec4(0.14F, 0.145F, 0.16F, 0.98F);
  colours[ImGuiCol_FrameBg] = ImVec4(0.19F, 0.195F, 0.215F, 1.0F);
  colours[ImGuiCol_FrameBgHovered] = ImVec4(0.24F, 0.245F, 0.27F, 1.0F);
  colours[ImGuiCol_FrameBgActive] = ImVec4(0.27F, 0.275F, 0.30F, 1.0F);
  colours[ImGuiCol_TitleBgActive] = ImVec4(0.20F, 0.205F, 0.225F, 1.0F);
  colours[ImGuiCol_Header] = ImVec4(0.20F, 0.205F, 0.225F, 1.0F);
  colours[ImGuiCol_HeaderHovered] = faint(0.35F);
  colours[ImGuiCol_HeaderActive] = faint(0.45F);
  colours[ImGuiCol_Button] = ImVec4(0.24F, 0.245F, 0.27F, 1.0F);
  colours[ImGuiCol_ButtonHovered] = faint(0.55F);
  colours[ImGuiCol_ButtonActive] = faint(0.75F);
  colours[ImGuiCol_SliderGrab] = faint(0.85F);
  colours[ImGuiCol_SliderGrabActive] = amber;
  colours[ImGuiCol_CheckMark] = amber;
  colours[ImGuiCol_TextSelectedBg] = faint(0.35F);
  colours[ImGuiCol_Separator] = ImVec4(0.25F, 0.255F, 0.28F, 1.0F);
}

}  // namespace

ImGuiCanvas::ImGuiCanvas(SDL_Window* window, SDL_Renderer* renderer) : renderer_(renderer) {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no files but those the user asks for
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  set_style();
  load_font();
  ImGui_ImplSDL2_InitForSDLRenderer(window);

  unsigned char* pixels = nullptr;
  int width = 0;
  int height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  font_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ABGR8888, SDL_TEXTUREACCESS_STATIC, width,
                            height);
  if (font_ == nullptr)
    throw std::runtime_error(fmt::format("cannot draw in the window: {}", SDL_GetError()));
  SDL_UpdateTexture(font_, nullptr, pixels, 4 * width);
  SDL_SetTextureBlendMode(font_, SDL_BLENDMODE_BLEND);
  io.Fonts->SetTexID(font_);
}

ImGuiCanvas::~ImGuiCanvas() {
  if (font_ != nullptr) SDL_DestroyTexture(font_);
  ImGui_ImplSDL2_Shutdown();
  ImGui::DestroyContext();
}

void ImGuiCanvas::begin_frame() {
  ImGui_ImplSDL2_NewFrame();
  // The part for SDL's events asks where the mouse is on the whole screen, which SDL does not learn
  // from every X server while a button is held down. The window's own events tell it always.
  ImVec2& mouse = ImGui::GetIO().MousePos;
  if (ImGui::IsMousePosValid(&mouse)) {
    int x = 0;
    int y = 0;
    SDL_GetMouseState(&x, &y);
    mouse = ImVec2(static_cast<float>(x), static_cast<float>(y));
  }
  ImGui::NewFrame();
}

void ImGuiCanvas::end_frame() {
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback != nullptr) continue;  // none of ours
      const ImVec4& box = command.ClipRect;
      const SDL_Rect clip{static_cast<int>(box.x), static_cast<int>(box.y),
                          static_cast<int>(box.z - box.x), static_cast<int>(box.w - box.y)};
      if (clip.w <= 0 || clip.h <= 0) continue;
      SDL_RenderSetClipRect(renderer_, &clip);
      const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
      constexpr int stride = sizeof(ImDrawVert);
      // ImGui packs colours as SDL_Color has them: bytes red, green, blue, alpha.
      SDL_RenderGeometryRaw(
          renderer_, static_cast<SDL_Texture*>(command.GetTexID()), &vertices->pos.x, stride,
          reinterpret_cast<const SDL_Color*>(&vertices->col), stride, &vertices->uv.x, stride,
          list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
          list.IdxBuffer.Data + command.IdxOffset, static_cast<int>(command.ElemCount),
          sizeof(ImDrawIdx));
    }
  }
  SDL_RenderSetClipRect(renderer_, nullptr);
}

}  // namespace knotlight
