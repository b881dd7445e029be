// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/keys.h"

namespace uvol_tools {

namespace {

using pcl_uvol::ImageSpaceSettings;

struct PassKey {
  char key;
  const char* help;
  void (*toggle)(ImageSpaceSettings& settings);
};

void
toggleSmoothing(ImageSpaceSettings& settings)
{
  using Filter = pcl_uvol::SmoothingFilter;
  settings.smoothing =
      settings.smoothing == Filter::None ? Filter::AlleviatedGaussian : Filter::None;
}

void
toggleIllustration(ImageSpaceSettings& settings)
{
  const bool is_illustration =
      !settings.shading && settings.silhouettes && settings.feature_lines;
  settings.shading = is_illustration;
  settings.silhouettes = settings.feature_lines = !is_illustration;
}

void
toggleFills(ImageSpaceSettings& settings)
{
  const ImageSpaceSettings usual;
  const bool fills = settings.background_fill > 0 || settings.occluded_fill > 0;
  settings.background_fill = fills ? 0 : usual.background_fill;
  settings.occluded_fill = fills ? 0 : usual.occluded_fill;
}

const PassKey pass_keys[] = {
    {'1', "light", [](ImageSpaceSettings& s) { s.shading = !s.shading; }},
    {'2', "smoothing", toggleSmoothing},
    {'3',
     "anti-aliasing",
     [](ImageSpaceSettings& s) { s.anti_aliasing = !s.anti_aliasing; }},
    {'4', "silhouettes", [](ImageSpaceSettings& s) { s.silhouettes = !s.silhouettes; }},
    {'5',
     "feature lines",
     [](ImageSpaceSettings& s) { s.feature_lines = !s.feature_lines; }},
    {'6', "lines without light", toggleIllustration},
    {'7',
     "footprints of points",
     [](ImageSpaceSettings& s) { s.footprints = !s.footprints; }},
    {'8', "filling of holes", toggleFills},
    {'9', "back faces", [](ImageSpaceSettings& s) {
       s.cull_back_faces = !s.cull_back_faces;
     }}};

} // namespace

std::string
describeKeys()
{
  std::string text = "left drag: turn   middle drag: move   wheel, right drag: zoom\n";
  for (const PassKey& key : pass_keys)
    text += std::string(1, key.key) + "  " + key.help + " on or off\n";
  return text + "click: values of a point   drop a file: open it\n"
                "f  turn about the point under the mouse\n"
                "k  cut away everything in front of that point, or show it\n"
                "c  colour by the next field\n"
                "m  mesh of the isosurface instead of its points, or back\n"
                "+ -  next isovalue (or drag the slider)\n"
                "=  type an isovalue, up to the return key\n"
                "i  keep the isovalue and move another one   I  keep none\n"
                "o  let light through isovalues around the innermost: opacity 1, 0.6, "
                "0.3\n"
                "x y z  from the right, the front and above (X Y Z: the other sides)\n"
                "r  whole surface in view\n"
                "s  save a picture   S  ray-traced   e  save the surface\n"
                "p  print the camera as options of uvol_render\n"
                "h  show or hide the keys\n"
                "q  quit";
}

const char*
sideOf(char key)
{
  switch (key) {
  case 'x':
    return "right";
  case 'X':
    return "left";
  case 'y':
    return "front";
  case 'Y':
    return "back";
  case 'z':
    return "top";
  case 'Z':
    return "bottom";
  default:
    return nullptr;
  }
}

bool
switchPass(char key, ImageSpaceSettings& settings)
{
  for (const PassKey& pass : pass_keys)
    if (pass.key == key) {
      pass.toggle(settings);
      return true;
    }
  return false;
}

} // namespace uvol_tools
