// SPDX-License-Identifier: BSD-3-Clause
// Reads the items of scenes.
#include "io/scene_file.h"

#include "common/printable.h"
#include "io/files.h"
#include "io/scene_words.h"
#include "render/point_colors.h"
#include "render/ray_tracing/scene_cloud.h"
#include <pcl_uvol/common/exceptions.h>
#include <pcl_uvol/io/dataset.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <map>

namespace pcl_uvol {

namespace {

namespace fs = std::filesystem;
using io::SceneItem;
using io::ScenePlace;

/** What a scene says about a cloud. */
struct CloudItem {
  ScenePlace place, color_place; ///< of the cloud, and of its field of colours
  std::string path;
  CloudLook look;
};

constexpr double radians_per_degree = 3.14159265358979323846 / 180.0;

constexpr io::NumberRange field_of_view{
    0.0, 180.0, false, "a number between 0 and 180"};

/** Bytes of a file: larger ones are clouds, given by mistake. */
constexpr std::uint64_t largest_file = std::uint64_t(16) << 20;

/** The whole of a scene file, whose bytes are those of a text. */
std::string
readText(const std::string& path)
{
  const io::InputFile file(path);
  if (file.getSize() > largest_file)
    io::throwUnreadable(path, {"too_many_parts", "the scene", largest_file, "bytes"});
  std::string text = file.head(file.getSize());
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.compare(0, byte_order_mark.size(), byte_order_mark) == 0)
    text.erase(0, byte_order_mark.size());
  const auto strange = std::find_if(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
  });
  if (strange != text.end())
    io::throwUnreadable(
        path,
        1 + static_cast<std::size_t>(std::count(text.begin(), strange, '\n')),
        {"not_text_file", static_cast<unsigned char>(*strange)});
  return text;
}

/** Clouds are read, and covered by splats. Errors start with the place of the item. */
void
addClouds(const std::vector<CloudItem>& items,
          unsigned threads,
          Report& report,
          SceneFile& file)
{
  std::vector<CloudLook> looks;
  std::vector<SceneCloud> clouds;
  for (const CloudItem& item : items) {
    const Dataset dataset = io::callAt(item.place, [&] {
      const StepTimer timer(report, "read");
      return loadDataset(item.path);
    });
    const std::vector<double> isovalues = listIsovalues(viewOf(dataset.cloud));
    file.isovalues.insert(isovalues.begin(), isovalues.end());
    looks.push_back(item.look);
    clouds.push_back(io::callAt(
        item.place, [&] { return coverCloud(dataset, item.look, threads, report); }));
    io::callAt(item.color_place,
               [&] { colorCloud(dataset, item.look, clouds.back()); });
  }
  const Eigen::Vector3d origin = findSceneOrigin(looks, clouds);
  for (std::size_t i = 0; i < items.size(); ++i) {
    io::callAt(items[i].place, [&] { placeCloud(looks[i], origin, clouds[i]); });
    file.scene.splats.push_back({clouds[i].splats,
                                 std::move(clouds[i].colors),
                                 looks[i].material,
                                 clouds[i].two_sided,
                                 std::move(clouds[i].rims)});
  }
  file.origin = {origin.x(), origin.y(), origin.z()};
}

/** A file as another file names it. */
std::string
pathFrom(const fs::path& folder, const std::string& name)
{
  return (folder / name).string();
}

class SceneReader {
public:
  explicit SceneReader(std::string folder)
      : folder_(std::move(folder))
  {
  }

  void
  read(const std::string& path, const std::string& text);

  /** \brief The scene, once all is read. */
  SceneFile
  finish(const std::string& path, unsigned threads, Report& report);

private:
  struct Kind {
    const char* form; ///< without options; starts with the name
    void (SceneReader::*read)(SceneItem& item);
  };
  static const Kind kinds[];

  void
  readItem(SceneItem& item);
  void
  readSize(SceneItem& item);
  void
  readCamera(SceneItem& item);
  void
  readBackground(SceneItem& item);
  /** A whole number in [low, high] for one of the settings. */
  template <int RayTracingSettings::*setting, int low, int high>
  void
  readWhole(SceneItem& item)
  {
    scene_.settings.*setting = item.whole(low, high);
    item.finish();
  }

  void
  readSupersampling(SceneItem& item);
  void
  readShadows(SceneItem& item);
  void
  readOcclusion(SceneItem& item);
  void
  readLight(SceneItem& item);
  void
  readMaterial(SceneItem& item);
  void
  readCloud(SceneItem& item);
  void
  readSphere(SceneItem& item);
  void
  readPlane(SceneItem& item);
  void
  readInclude(SceneItem& item);

  RayMaterial
  takeMaterial(SceneItem& item) const;

  const std::string folder_;
  std::vector<std::string> files_; ///< each included by the one before
  std::size_t included_ = 0;       ///< in all
  SceneFile scene_;                ///< in the coordinates of the files
  std::vector<CloudItem> clouds_;
  std::map<std::string, std::pair<RayMaterial, ScenePlace>> materials_;
  bool has_lights_ = false;
};

const SceneReader::Kind SceneReader::kinds[] = {
    {"size W H", &SceneReader::readSize},
    {"camera", &SceneReader::readCamera},
    {"background r g b | gradient r g b r g b | transparent",
     &SceneReader::readBackground},
    {"depth n", &SceneReader::readWhole<&RayTracingSettings::depth, 0, 10000>},
    {"supersampling n", &SceneReader::readSupersampling},
    {"shadows on|off", &SceneReader::readShadows},
    {"light-samples n",
     &SceneReader::readWhole<&RayTracingSettings::light_samples, 1, 4096>},
    {"occlusion n", &SceneReader::readOcclusion},
    {"light point|directional|camera x y z", &SceneReader::readLight},
    {"material NAME", &SceneReader::readMaterial},
    {"cloud FILE", &SceneReader::readCloud},
    {"sphere x y z RADIUS", &SceneReader::readSphere},
    {"plane x y z nx ny nz", &SceneReader::readPlane},
    {"include FILE", &SceneReader::readInclude}};

void
SceneReader::read(const std::string& path, const std::string& text)
{
  files_.push_back(path);
  io::Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    SceneItem item({path, lines.lineNumber(), 1}, line);
    if (!item.atEnd())
      readItem(item);
  }
  files_.pop_back();
}

void
SceneReader::readItem(SceneItem& item)
{
  const std::string name = item.word("an item");
  std::vector<std::string> names;
  for (const Kind& kind : kinds) {
    names.push_back(io::cutName(kind.form));
    if (names.back() != name)
      continue;
    item.setForm(kind.form);
    (this->*kind.read)(item);
    return;
  }
  item.fail({"unknown_word", shortenText(name), "items", io::joinWords(names)});
}

void
SceneReader::readSize(SceneItem& item)
{
  const int width = item.whole(1, 16384);
  const int height = item.whole(1, 16384);
  item.finish();
  scene_.size = {width, height};
}

void
SceneReader::readCamera(SceneItem& item)
{
  const ScenePlace place = item.place();
  Camera camera;
  camera.up = {0.0, 0.0, 1.0};
  item.options(
      {{"eye x y z", [&] { camera.eye = item.point(); }},
       {"at x y z", [&] { camera.at = item.point(); }},
       {"up x y z", [&] { camera.up = item.direction(); }},
       {"fov degrees", [&] { camera.vertical_fov = item.number(field_of_view); }}});
  if (!item.hasOption("eye") || !item.hasOption("at"))
    io::throwAt(place, {"incomplete_entry", "a camera", "'eye x y z' and 'at x y z'"});
  io::callAt(place, [&] { camera.rotation(); });
  scene_.camera = camera;
}

void
SceneReader::readBackground(SceneItem& item)
{
  Background background;
  if (item.takeIf("transparent"))
    background.kind = Background::Kind::Transparent;
  else if (item.takeIf("gradient")) {
    background.kind = Background::Kind::Gradient;
    background.color = item.color();
    background.top = item.color();
  }
  else
    background.color = item.color();
  item.finish();
  scene_.scene.background = background;
}

void
SceneReader::readSupersampling(SceneItem& item)
{
  scene_.supersampling = item.whole(1, 8);
  item.finish();
}

void
SceneReader::readShadows(SceneItem& item)
{
  const std::string state = item.word("on or off");
  if (state != "on" && state != "off")
    item.fail({"unexpected_word", shortenText(state), "on or off"});
  item.finish();
  scene_.settings.shadows = state == "on";
}

void
SceneReader::readOcclusion(SceneItem& item)
{
  RayTracingSettings& settings = scene_.settings;
  settings.occlusion_samples = item.whole(0, 4096);
  settings.occlusion_distance = RayTracingSettings().occlusion_distance;
  item.options({{"distance d",
                 [&] { settings.occlusion_distance = item.number(io::positive); }}});
}

void
SceneReader::readLight(SceneItem& item)
{
  const std::string kind = item.word("point, directional or camera");
  Light light;
  if (kind != "point" && kind != "directional" && kind != "camera")
    item.fail(
        {"unknown_word", shortenText(kind), "lights", "point, directional and camera"});
  light.kind = kind == "point" ? Light::Kind::Point : Light::Kind::Directional;
  light.follows_camera = kind == "camera";
  light.position = kind == "point" ? item.point() : item.direction();
  item.options({{"color r g b", [&] { light.color = item.color(); }},
                {"radius r", [&] { light.radius = item.number(io::not_negative); }}});
  if (!has_lights_)
    scene_.scene.lights.clear();
  has_lights_ = true;
  scene_.scene.lights.push_back(light);
}

void
SceneReader::readMaterial(SceneItem& item)
{
  const std::string name = item.word("the name of a material");
  const ScenePlace place = item.place();
  if (const auto before = materials_.find(name); before != materials_.end())
    item.fail(
        {"repeated_part",
         "the material " + quoteText(name) + " of " + before->second.second.text()});
  RayMaterial made;
  const auto factor = [&item](double& target) {
    return [&item, &target] { target = item.number(io::not_negative); };
  };
  const auto part = [&item](double& target) {
    return [&item, &target] { target = item.number(io::zero_to_one); };
  };
  item.options(
      {{"color r g b", [&] { made.color = item.color(); }},
       {"ambient a", factor(made.ambient)},
       {"diffuse d", factor(made.diffuse)},
       {"specular s", factor(made.specular)},
       {"shininess e", factor(made.shininess)},
       {"reflect r", part(made.reflectivity)},
       {"transparent t", part(made.transparency)},
       {"index n", [&] { made.refractive_index = item.number(io::positive); }}});
  if (made.reflectivity + made.transparency > 1.0)
    io::throwAt(place, {"bright_material", shortenText(name)});
  materials_[name] = {made, place};
}

RayMaterial
SceneReader::takeMaterial(SceneItem& item) const
{
  const std::string name = item.word("the name of a material");
  if (const auto found = materials_.find(name); found != materials_.end())
    return found->second.first;
  std::vector<std::string> names;
  for (const auto& known : materials_)
    names.push_back(shortenText(known.first));
  item.fail({"unknown_word",
             shortenText(name),
             "materials in front of this line",
             names.empty() ? "none" : io::joinWords(names)});
}

std::vector<SceneItem::Option>
placementOptions(SceneItem& item, CloudPlacement& placement)
{
  return {{"fit x y z SIZE",
           [&] {
             placement.at = item.point();
             placement.fit_size = item.number(io::positive);
           }},
          {"turn ax ay az degrees",
           [&] {
             const Eigen::Vector3d axis = item.direction().normalized();
             const double angle = radians_per_degree * item.number(io::any_number);
             placement.turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
           }},
          {"scale s", [&] { placement.scale = item.number(io::positive); }},
          {"at x y z", [&] { placement.at = item.point(); }}};
}

std::vector<SceneItem::Option>
colorOptions(SceneItem& item, CloudItem& cloud)
{
  return {{"color FIELD",
           [&] {
             cloud.look.color_field = item.word("the name of a field");
             cloud.color_place = item.place();
           }},
          {"colormap NAME",
           [&] {
             const std::string name = item.word("the name of a map");
             cloud.look.color_map =
                 io::callAt(item.place(), [&name] { return ColorMap(name); });
           }},
          {"range low high", [&] {
             const double low = item.number(io::any_number);
             const double high = item.number(io::any_number);
             if (low > high)
               item.fail({"incomplete_entry",
                          "a range of colours",
                          "a high end above its low end"});
             cloud.look.color_range = {low, high};
           }}};
}

void
SceneReader::readCloud(SceneItem& item)
{
  CloudItem cloud;
  cloud.place = cloud.color_place = item.place();
  CloudLook& look = cloud.look;
  look.name = item.word("the name of a file");
  cloud.path = pathFrom(folder_.empty() ? fs::path(files_.back()).parent_path()
                                        : fs::path(folder_),
                        look.name);
  SplatParameters& parameters = look.parameters;
  const auto takeDelta = [&](bool is_length) {
    parameters.delta = item.number(io::positive);
    parameters.delta_is_length = is_length;
  };
  std::vector<SceneItem::Option> options = {
      {"material NAME", [&] { look.material = takeMaterial(item); }},
      {"delta d", [&] { takeDelta(false); }},
      {"delta-abs length", [&] { takeDelta(true); }},
      {"lambda l", [&] { parameters.lambda = item.number(io::zero_to_one); }}};
  for (const auto& more :
       {placementOptions(item, look.placement), colorOptions(item, cloud)})
    options.insert(options.end(), more.begin(), more.end());
  item.options(options, {{"fit", "scale"}, {"fit", "at"}, {"delta", "delta-abs"}});
  look.has_parameters = item.hasOption("delta") || item.hasOption("delta-abs") ||
                        item.hasOption("lambda");
  if ((item.hasOption("colormap") || item.hasOption("range")) &&
      (look.color_field.empty() || look.color_field == "rgb" ||
       look.color_field == "rgba"))
    io::throwAt(cloud.place,
                {"incomplete_entry",
                 "the word colormap or range",
                 "'color FIELD' with a scalar field"});
  clouds_.push_back(std::move(cloud));
}

void
SceneReader::readSphere(SceneItem& item)
{
  SphereObject sphere;
  sphere.center = item.point();
  sphere.radius = item.number(io::positive);
  item.options({{"material NAME", [&] { sphere.material = takeMaterial(item); }}});
  scene_.scene.spheres.push_back(sphere);
}

void
SceneReader::readPlane(SceneItem& item)
{
  PlaneObject plane;
  plane.point = item.point();
  plane.normal = item.direction();
  item.options({{"material NAME", [&] { plane.material = takeMaterial(item); }},
                {"checker SIZE r g b", [&] {
                   plane.square = item.number(io::positive);
                   plane.other_color = item.color();
                 }}});
  scene_.scene.planes.push_back(plane);
}

void
SceneReader::readInclude(SceneItem& item)
{
  const std::string path =
      pathFrom(fs::path(files_.back()).parent_path(), item.word("the name of a file"));
  const ScenePlace place = item.place();
  item.finish();
  const std::string text = io::callAt(place, [&] { return readText(path); });
  constexpr std::size_t most_included = 1000;
  if (++included_ > most_included)
    io::throwAt(place,
                {"too_many_parts",
                 "the scene",
                 most_included,
                 "included files, counted as often as they are named"});
  const auto same = std::find_if(files_.begin(), files_.end(), [&](const auto& file) {
    std::error_code ignored;
    return fs::equivalent(file, path, ignored);
  });
  if (same != files_.end()) {
    std::string circle;
    for (auto file = same; file != files_.end(); ++file)
      circle += printable(*file) + " -> ";
    io::throwAt(place, {"endless_inclusion", circle + printable(path)});
  }
  read(path, text);
}

SceneFile
SceneReader::finish(const std::string& path, unsigned threads, Report& report)
{
  Scene& scene = scene_.scene;
  if (clouds_.empty() && scene.spheres.empty() && scene.planes.empty())
    throw IOError("empty_scene", {{"path", printable(path)}});
  addClouds(clouds_, threads, report, scene_);
  const Eigen::Vector3d origin = Eigen::Map<Eigen::Vector3d>(scene_.origin.data());
  for (SphereObject& sphere : scene.spheres)
    sphere.center -= origin;
  for (PlaneObject& plane : scene.planes)
    plane.point -= origin;
  for (Light& light : scene.lights)
    if (light.kind == Light::Kind::Point)
      light.position -= origin;
  if (scene_.camera) {
    scene_.camera->eye -= origin;
    scene_.camera->at -= origin;
  }
  return std::move(scene_);
}

} // namespace

SceneFile
loadScene(const std::string& path,
          const std::string& folder,
          unsigned threads,
          Report& report)
{
  SceneReader reader(folder);
  reader.read(path, readText(path));
  return reader.finish(path, threads, report);
}

} // namespace pcl_uvol
