// SPDX-License-Identifier: BSD-3-Clause
// Boxes, axes, directions and lengths in pictures of surfaces.
#include "charts/data_box.h"
#include "charts/figure.h"
#include "charts/text_wrap.h"
#include "charts/view_marks.h"
#include <pcl_uvol/render/image_space/image_space_renderer.h>

#include <gtest/gtest.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace test_view_figures {

using Eigen::Vector3d;
using pcl_uvol::Camera;
using pcl_uvol::Image;
using uvol_tools::DataBox;
using uvol_tools::Ink;
using uvol_tools::MarkStyle;
using uvol_tools::Perspective;
using uvol_tools::Pixel;

constexpr int side = 400;
const MarkStyle style{12, {0, 0, 0}};

Image
makePaper()
{
  Image image;
  image.width = image.height = side;
  image.color.assign(4 * image.pixels(), 255);
  return image;
}

/** How dark the darkest pixel is within a pixel of a place. */
int
darknessAt(const Image& image, const Pixel& place)
{
  int darkest = 255;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const auto column = static_cast<std::size_t>(std::lround(place[0]) + dx),
                 row = static_cast<std::size_t>(std::lround(place[1]) + dy);
      darkest = std::min(darkest, int{image.color[4 * (row * image.width + column)]});
    }
  return 255 - darkest;
}

Camera
lookAt(const Vector3d& eye, const Vector3d& at)
{
  Camera camera;
  camera.eye = eye;
  camera.at = at;
  camera.up = Vector3d::UnitZ();
  return camera;
}

DataBox
unitBox()
{
  return {{Vector3d::Zero(), Vector3d::Ones()}, Vector3d::Zero(), Vector3d::Ones(), ""};
}

TEST(Perspective, HitsThePixelsOfTheRenderer)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-1.0f, 1.0f);
  for (int i = 0; i < 20; ++i)
    cloud->push_back({coordinate(random), coordinate(random), coordinate(random)});
  const Camera camera = lookAt({3.0, -5.0, 2.0}, {0.1, 0.0, -0.1});
  pcl_uvol::ImageSpaceRenderer<pcl::PointXYZ> renderer;
  renderer.setInputCloud(cloud);
  renderer.setCamera(camera);
  constexpr int width = 300, height = 200;
  renderer.setSize(width, height);
  renderer.settings().footprints = false;
  renderer.settings().background_fill = renderer.settings().occluded_fill = 0;
  pcl_uvol::ImagePlanes planes;
  planes.id = true;
  renderer.setPlanes(planes);
  Image image;
  renderer.render(image);
  const Perspective perspective(camera, width, height, 10, 20);
  int seen = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    if (image.id[i] == Image::background)
      continue;
    const auto& point = (*cloud)[image.id[i]];
    const Pixel pixel =
        perspective.pixelOf(perspective.seenFromEye({point.x, point.y, point.z}));
    EXPECT_NEAR(static_cast<double>(i % width), pixel[0] - 10.0, 0.51);
    EXPECT_NEAR(static_cast<double>(i / width), pixel[1] - 20.0, 0.51);
    ++seen;
  }
  EXPECT_GT(seen, 15);
}

TEST(DataBox, HasHiddenEdgesBehindAndNearOnesBefore)
{
  const DataBox box = unitBox();
  const Perspective perspective(
      lookAt({2.5, -3.0, 2.5}, {0.5, 0.5, 0.5}), side, side, 0, 0);
  Image behind = makePaper(), before = makePaper();
  uvol_tools::drawBoxBehind(behind, perspective, box, style, false);
  uvol_tools::drawBoxBefore(before, perspective, box, style);
  int near_edges = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {0.0, 1.0})
      for (const double b : {0.0, 1.0}) {
        Vector3d middle;
        middle[axis] = 0.37; // where no other edge is near
        middle[(axis + 1) % 3] = a;
        middle[(axis + 2) % 3] = b;
        const Pixel place = perspective.pixelOf(perspective.seenFromEye(middle));
        // The eye is beyond x = 1, y = 0 and z = 1.
        const Vector3d facing(1.0, 0.0, 1.0);
        const bool is_near = middle[(axis + 1) % 3] == facing[(axis + 1) % 3] &&
                             middle[(axis + 2) % 3] == facing[(axis + 2) % 3];
        near_edges += is_near ? 1 : 0;
        EXPECT_EQ(is_near, darknessAt(behind, place) < 50) << axis << a << b;
        EXPECT_EQ(is_near, darknessAt(before, place) > 50) << axis << a << b;
      }
  EXPECT_EQ(3, near_edges);
}

TEST(DataBox, SaysTheValuesOfTheDataWhateverThePictureIsDrawnIn)
{
  const auto draw = [](const DataBox& box, const Camera& camera) {
    Image image = makePaper();
    uvol_tools::drawBoxBehind(
        image, Perspective(camera, side, side, 0, 0), box, style, true);
    return image.color;
  };
  const Vector3d eye(3.0, -4.0, 2.0), at(0.5, 0.5, 0.5), shift(-8.0, 16.0, 4.0);
  const auto plain = draw(unitBox(), lookAt(eye, at));
  EXPECT_NE(makePaper().color, plain);
  const DataBox shifted{
      {shift, shift + Vector3d::Ones()}, -shift, Vector3d::Ones(), ""};
  EXPECT_EQ(plain, draw(shifted, lookAt(eye + shift, at + shift)));
  const DataBox doubled{{Vector3d::Zero(), 2.0 * Vector3d::Ones()},
                        Vector3d::Zero(),
                        2.0 * Vector3d::Ones(),
                        ""};
  EXPECT_EQ(plain, draw(doubled, lookAt(2.0 * eye, 2.0 * at)));
  DataBox other = unitBox();
  other.factors = {1.0, 0.5, 1.0};
  EXPECT_NE(plain, draw(other, lookAt(eye, at)));
  other = unitBox();
  other.unit = "km";
  EXPECT_NE(plain, draw(other, lookAt(eye, at)));
}

/** What the letters along x say, in a picture seen from the front. */
std::vector<std::string>
valuesAlongX(double low, double high, int font)
{
  DataBox box = unitBox();
  box.box.min().x() = low;
  box.box.max().x() = high;
  const double middle = 0.5 * (low + high), size = high - low;
  const Perspective perspective(
      lookAt({middle, -3.0 * size, 0.1 * size}, {middle, 0.5, 0.0}), side, side, 0, 0);
  const uvol_tools::SeenBox seen(perspective, box);
  std::vector<std::string> texts;
  for (const auto& letters : uvol_tools::layOutAxis(seen, 0, {font, {}}).letters)
    texts.push_back(letters.line.text);
  EXPECT_EQ("x", texts.back());
  texts.pop_back();
  return texts;
}

TEST(DataBox, HasValuesInEvenSteps)
{
  using Texts = std::vector<std::string>;
  EXPECT_EQ((Texts{"-40", "-20", "0", "20", "40"}), valuesAlongX(-45.0, 45.0, 12));
  EXPECT_EQ((Texts{"-40", "0", "40"}), valuesAlongX(-45.0, 45.0, 30));
  // Of one value no scale can be read.
  EXPECT_EQ((Texts{"-40", "40"}), valuesAlongX(-45.0, 45.0, 80));
  EXPECT_EQ((Texts{"-40", "40"}), valuesAlongX(-45.0, 45.0, 200));
  EXPECT_EQ((Texts{"20", "40", "60", "80"}), valuesAlongX(15.0, 95.0, 12));
  EXPECT_EQ((Texts{"20", "60"}), valuesAlongX(15.0, 95.0, 45));
  EXPECT_EQ((Texts{"20", "80"}), valuesAlongX(15.0, 95.0, 90));
}

TEST(DataBox, LettersOfAThinBoxMakeRoomForEachOther)
{
  DataBox box = unitBox();
  box.box.max().z() = 0.02;
  const Perspective perspective(
      lookAt({2.5, -3.0, 1.0}, {0.5, 0.5, 0.0}), side, side, 0, 0);
  const auto marks =
      uvol_tools::layOutAxis(uvol_tools::SeenBox(perspective, box), 2, style);
  ASSERT_EQ(3u, marks.letters.size());
  ASSERT_EQ(2u, marks.ticks.size());
  const auto& low = marks.letters[0].line;
  const auto& high = marks.letters[1].line;
  EXPECT_EQ("0", low.text);
  EXPECT_EQ("0.02", high.text);
  EXPECT_LT(std::abs(marks.ticks[0][0][1] - marks.ticks[1][0][1]), 6.0);
  EXPECT_GE(low.row - high.row, 10);
  EXPECT_LE(low.row - high.row, 12);
}

TEST(DataBox, IsDrawnFromInsideAndWithoutAThickness)
{
  Image image = makePaper();
  uvol_tools::drawBoxBehind(
      image,
      Perspective(lookAt({0.5, 0.5, 0.5}, {0.9, 0.8, 0.6}), side, side, 0, 0),
      unitBox(),
      style,
      true);
  EXPECT_NE(makePaper().color, image.color);
  DataBox flat = unitBox();
  flat.box.max().z() = 0.0;
  image = makePaper();
  uvol_tools::drawBoxBehind(
      image,
      Perspective(lookAt({2.0, -3.0, 2.0}, {0.5, 0.5, 0.0}), side, side, 0, 0),
      flat,
      style,
      true);
  EXPECT_NE(makePaper().color, image.color);
}

TEST(Triad, PointsRightAndUp)
{
  Image image = makePaper();
  const Perspective front(lookAt({0.0, -5.0, 0.0}, {0.0, 0.0, 0.0}), side, side, 0, 0);
  uvol_tools::drawTriad(image, front, {200.0, 200.0}, 60.0, style);
  const auto inkAt = [&](std::size_t column, std::size_t row) {
    const std::uint8_t* const pixel = &image.color[4 * (row * side + column)];
    return Ink{pixel[0], pixel[1], pixel[2]};
  };
  const Ink x = inkAt(230, 200), z = inkAt(200, 170), paper{255, 255, 255};
  EXPECT_GT(x[0], x[2] + 100);
  EXPECT_GT(z[2], z[0] + 100);
  EXPECT_EQ(paper, inkAt(170, 200));
  EXPECT_EQ(paper, inkAt(200, 230));
}

TEST(Triad, LeavesLettersOfAxesAlone)
{
  pcl::PointCloud<pcl::PointXYZ> corners;
  corners.push_back({0.0f, 0.0f, 0.0f});
  corners.push_back({1.0f, 1.0f, 1.0f});
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(corners);
  const uvol_tools::Subject subject{cloud, {{0.5, 0.5, 0.5}, 0.9}, {}};
  const auto draw = [&](bool has_triad, double fill) {
    uvol_tools::Figure figure;
    figure.has_ticks = true;
    figure.has_triad = has_triad;
    return figure.drawViews(
        subject,
        {{}, side, side, side},
        [&](const pcl_uvol::SeenSurface& seen, const auto&) {
          pcl_uvol::CameraChoice choice;
          choice.view = "front";
          choice.fill = {fill};
          return pcl_uvol::chooseCamera(choice, seen, {}, 1.0);
        },
        [](const Camera&, const auto& cell, Image& image) {
          image = makePaper();
          EXPECT_EQ(side, cell.width);
          std::fill(image.color.begin(), image.color.end(), std::uint8_t{0});
        });
  };
  for (const double fill : {0.5, 0.65}) {
    const Image axes = draw(false, fill), both = draw(true, fill);
    std::size_t added = 0;
    for (std::size_t i = 0; i < axes.pixels(); ++i) {
      const auto pixel = axes.color.begin() + static_cast<std::ptrdiff_t>(4 * i);
      const bool is_same = std::equal(pixel, pixel + 4, &both.color[4 * i]);
      EXPECT_TRUE(is_same || pixel[0] == 255) << fill << ' ' << i;
      added += is_same ? 0 : 1;
    }
    EXPECT_GT(added, 100u) << fill;
  }
}

TEST(ScaleBar, HasARoundLengthOfTheUnit)
{
  // Pixels per unit and what fits, and the pixels of 1, 2 or 5 times a power of ten.
  const std::pair<std::array<double, 2>, double> cases[] = {{{10.0, 57.0}, 50.0},
                                                            {{10.0, 49.0}, 20.0},
                                                            {{1000.0, 199.0}, 100.0},
                                                            {{0.02, 90.0}, 40.0}};
  for (const auto& [bar, length] : cases) {
    Image image = makePaper();
    uvol_tools::drawScaleBar(image, {300.0, 300.0}, {bar[0], bar[1], "m"}, style);
    const auto isInk = [&](double column) {
      return image.color[4 * (300 * side + static_cast<std::size_t>(column))] < 100;
    };
    EXPECT_TRUE(isInk(300.0 - length + 1.0) && isInk(299.0)) << bar[0];
    EXPECT_FALSE(isInk(300.0 - length - 3.0) || isInk(303.0)) << bar[0];
  }
  Image image = makePaper();
  uvol_tools::drawScaleBar(image, {300.0, 300.0}, {-1.0, 50.0, "m"}, style);
  EXPECT_EQ(makePaper().color, image.color);
  EXPECT_EQ("10000 ft", uvol_tools::ScaleBar(0.01, 150.0, "ft").text);
}

TEST(ScaleBar, LeavesWhatIsDrawnAlone)
{
  pcl::PointCloud<pcl::PointXYZ> corners;
  corners.push_back({0.0f, 0.0f, 0.0f});
  corners.push_back({1.0f, 1.0f, 1.0f});
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(corners);
  uvol_tools::Figure figure;
  figure.has_scale_bar = true;
  // The quarters of the picture that are drawn, and where the bar has to be.
  using Quarters = std::vector<std::pair<bool, bool>>; // to the right, below
  const std::pair<Quarters, std::pair<bool, bool>> cases[] = {
      {{}, {true, true}},
      {{{true, true}}, {false, true}},
      {{{true, true}, {false, true}}, {true, false}},
      {{{true, true}, {false, true}, {true, false}}, {false, false}}};
  for (const auto& [drawn, place] : cases) {
    Image plain = makePaper();
    const Image image = figure.drawViews(
        {cloud, {{0.5, 0.5, 0.5}, 0.9}, {}},
        {{}, side, side, side},
        [](const pcl_uvol::SeenSurface& seen, const auto&) {
          return pcl_uvol::chooseCamera({}, seen, {}, 1.0);
        },
        [&quarters = drawn, &plain](const Camera&, const auto&, Image& view) {
          view = makePaper();
          for (std::size_t i = 0; i < view.pixels(); ++i) {
            const std::pair at(i % side >= side / 2, i / side >= side / 2);
            const bool is_drawn =
                std::find(quarters.begin(), quarters.end(), at) != quarters.end();
            std::fill_n(&view.color[4 * i], 3, std::uint8_t{128});
            view.color[4 * i + 3] = is_drawn ? 255 : 0;
            if (is_drawn)
              std::copy_n(&view.color[4 * i], 4, &plain.color[4 * i]);
          }
        });
    std::size_t added = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      if (std::equal(&image.color[4 * i], &image.color[4 * i + 4], &plain.color[4 * i]))
        continue;
      ++added;
      EXPECT_EQ(place, std::pair(i % side >= side / 2, i / side >= side / 2));
    }
    EXPECT_GT(added, 100u);
  }
}

/** Draws a box with axes, and gives all lines of text. */
std::vector<uvol_tools::TextLine>
writeBox(const uvol_tools::Figure& figure,
         const Vector3d& size,
         const Vector3d& origin,
         const uvol_tools::Ground& ground,
         const std::string& view,
         Eigen::AlignedBox2d& box)
{
  pcl::PointCloud<pcl::PointXYZ> corners;
  corners.push_back({0.0f, 0.0f, 0.0f});
  corners.push_back({static_cast<float>(size.x()),
                     static_cast<float>(size.y()),
                     static_cast<float>(size.z())});
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(corners);
  const std::array<double, 3> shift{origin.x(), origin.y(), origin.z()};
  const uvol_tools::TextKeeper keeper;
  figure.drawViews(
      {cloud, {0.5 * size, 0.5 * size.norm()}, shift},
      ground,
      [&](const pcl_uvol::SeenSurface& seen, const uvol_tools::PictureCell& cell) {
        pcl_uvol::CameraChoice choice;
        choice.view = view;
        choice.fill = cell.fill;
        choice.zoom = ground.zoom;
        choice.turns = ground.turns;
        return pcl_uvol::chooseCamera(
            choice, seen, shift, static_cast<double>(cell.width) / cell.height);
      },
      [&](const Camera& camera, const uvol_tools::PictureCell& cell, Image& image) {
        image.width = static_cast<std::uint32_t>(cell.width);
        image.height = static_cast<std::uint32_t>(cell.height);
        image.color.assign(4 * image.pixels(), 0);
        const Perspective perspective(camera, cell.width, cell.height, 0, 0);
        for (int i = 0; i < 8; ++i) {
          Vector3d corner;
          for (int axis = 0; axis < 3; ++axis)
            corner[axis] = (i >> axis & 1) != 0 ? size[axis] : 0.0;
          box.extend(Eigen::Vector2d(
              perspective.pixelOf(perspective.seenFromEye(corner)).data()));
        }
      });
  return keeper.getLines();
}

TEST(Figure, AxesHaveRoomInThePictureAndNoMore)
{
  uvol_tools::Figure figure;
  figure.has_ticks = true;
  figure.unit = "m";
  const Vector3d sizes[] = {{1.0, 1.0, 1.0}, {60.0, 10.0, 10.0}, {0.1, 0.2, 3.0}};
  const Vector3d origins[] = {Vector3d::Zero(), {500000.25, 5400000.1, -17.0}};
  for (const Vector3d& size : sizes)
    for (const Vector3d& origin : origins)
      for (const std::string& view : Camera::viewNames())
        for (const auto& [width, height] :
             {std::pair(400, 300), std::pair(1004, 709)}) {
          Eigen::AlignedBox2d box;
          const auto lines =
              writeBox(figure, size, origin, {{}, width, height, width}, view, box);
          Eigen::AlignedBox2d letters = box;
          for (const uvol_tools::TextLine& line : lines)
            letters.extend(uvol_tools::boxAround(line));
          const Eigen::Vector2d before = letters.min(),
                                behind = Eigen::Vector2d(width - 1, height - 1) -
                                         letters.max();
          EXPECT_GE(before.minCoeff(), 0.0) << view << ' ' << size.transpose();
          EXPECT_GE(behind.minCoeff(), 0.0) << view << ' ' << size.transpose();
          // In one of both directions it fills the picture.
          const Eigen::Vector2d free =
              (before + behind).cwiseQuotient(Eigen::Vector2d(width, height));
          EXPECT_LT(free.minCoeff(), 0.13) << view << ' ' << size.transpose();
        }
}

TEST(Figure, EveryAxisOfASmallPrintHasTwoValues)
{
  uvol_tools::Figure figure;
  figure.has_ticks = true;
  figure.least_letters = 29; // 7 points at 300 dpi
  Eigen::AlignedBox2d box;
  const auto lines = writeBox(
      figure, {60.0, 10.0, 10.0}, Vector3d::Zero(), {{}, 1004, 709, 1004}, "iso", box);
  std::map<char, int> values;
  int count = 0;
  for (const uvol_tools::TextLine& line : lines) {
    const bool is_name = std::isalpha(static_cast<unsigned char>(line.text[0])) != 0;
    if (is_name)
      values[line.text[0]] = count;
    count = is_name ? 0 : count + 1;
  }
  for (const char axis : {'x', 'y', 'z'})
    EXPECT_GE(values[axis], 2) << axis;
  EXPECT_GT(box.sizes().x(), 0.7 * 1004);
}

TEST(Figure, OffsetsOfAnAxisHaveTheirOwnLine)
{
  uvol_tools::Figure figure;
  figure.has_ticks = true;
  figure.unit = "m";
  Eigen::AlignedBox2d box;
  const auto lines = writeBox(figure,
                              {0.5, 0.2, 0.1},
                              {500000.0, 5400000.0, 0.0},
                              {{}, 400, 300, 400},
                              "iso",
                              box);
  std::size_t offsets = 0;
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (lines[i].text == "+ 500000" || lines[i].text == "+ 5400000") {
      ++offsets;
      EXPECT_EQ(offsets == 1 ? "x (m)" : "y (m)", lines[i - 1].text);
      EXPECT_GT(lines[i].row, lines[i - 1].row + 11);
    }
  EXPECT_EQ(2u, offsets);
}

TEST(Figure, FramesOfATurnAndZoomedPicturesHaveOneFit)
{
  uvol_tools::Figure figure;
  figure.has_ticks = true;
  const Vector3d size(3.0, 2.0, 1.0);
  const auto widthOf = [&](bool turns, double zoom) {
    Eigen::AlignedBox2d box;
    writeBox(figure,
             size,
             Vector3d::Zero(),
             {{}, 400, 300, 400, Vector3d::Ones(), turns, zoom},
             "front",
             box);
    return box.sizes().x();
  };
  EXPECT_NEAR(2.0 * widthOf(false, 1.0), widthOf(false, 2.0), 0.01);
  EXPECT_LT(widthOf(true, 1.0), widthOf(false, 1.0));
  EXPECT_GT(widthOf(true, 1.0), 0.5 * widthOf(false, 1.0));
}

TEST(Figure, LongTitlesAreBrokenAndHaveTheirRoom)
{
  uvol_tools::Figure figure;
  figure.has_ticks = true;
  Eigen::AlignedBox2d box;
  const uvol_tools::Ground ground{{}, 400, 300, 400};
  writeBox(figure, Vector3d::Ones(), Vector3d::Zero(), ground, "front", box);
  const double height = box.sizes().y();
  figure.title = "A title of a figure that is a good deal longer than the picture is "
                 "wide, indeed";
  box.setEmpty();
  writeBox(figure, Vector3d::Ones(), Vector3d::Zero(), ground, "front", box);
  EXPECT_LT(box.sizes().y(), height - 40.0);
  const uvol_tools::TextKeeper keeper;
  Image image = makePaper();
  figure.drawTitle(image);
  ASSERT_EQ(2u, keeper.getLines().size());
  EXPECT_EQ(figure.title, keeper.getLines()[0].text + " " + keeper.getLines()[1].text);
  for (const uvol_tools::TextLine& line : keeper.getLines()) {
    EXPECT_GE(uvol_tools::boxAround(line).min().x(), 0.0);
    EXPECT_LT(uvol_tools::boxAround(line).max().x(), side);
  }
  EXPECT_FALSE([&] {
    figure.title.append(5000, 'x');
    return figure.fits(side, side);
  }());
}

TEST(TextWrap, BreaksAtBlanksThenAtSignsThenAnywhere)
{
  using Texts = std::vector<std::string>;
  const auto wrap = [](const std::string& text, const std::string& widest) {
    return uvol_tools::wrapText(text, 12, uvol_tools::measureText(widest, 12));
  };
  EXPECT_EQ((Texts{"short"}), wrap("short", "short"));
  EXPECT_EQ((Texts{""}), wrap("", "short"));
  EXPECT_EQ((Texts{"two", "words"}), wrap("two  words", "words "));
  EXPECT_EQ((Texts{"flux", "(kg m-2)"}), wrap("flux (kg m-2)", "flux (kg mm"));
  EXPECT_EQ((Texts{"(kg m-2", "s-1)"}), wrap("(kg m-2 s-1)", "(kg m-2 s"));
  EXPECT_EQ((Texts{"log10(x)+", "log10(y)"}),
            wrap("log10(x)+log10(y)", "log10(x)+log"));
  EXPECT_EQ((Texts{"aaaa", "aaaa", "a"}), wrap("aaaaaaaaa", "aaaa"));
  // letters of several bytes stay whole, and each line has one
  EXPECT_EQ((Texts{"\u00e4", "\u00f6"}), wrap("\u00e4\u00f6", ""));
}

TEST(ScaleBar, MakesPalerWhatItLiesOn)
{
  pcl::PointCloud<pcl::PointXYZ> corners;
  corners.push_back({0.0f, 0.0f, 0.0f});
  corners.push_back({1.0f, 1.0f, 1.0f});
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(corners);
  for (const std::uint8_t opacity : {std::uint8_t{255}, std::uint8_t{0}}) {
    uvol_tools::Figure figure;
    figure.has_scale_bar = true;
    uvol_tools::Ground ground{{}, side, side, side};
    if (opacity == 0)
      ground.background.kind = pcl_uvol::Background::Kind::Transparent;
    const Image image = figure.drawViews(
        {cloud, {{0.5, 0.5, 0.5}, 0.9}, {}},
        ground,
        [](const pcl_uvol::SeenSurface& seen, const auto&) {
          return pcl_uvol::chooseCamera({}, seen, {}, 1.0);
        },
        [](const Camera&, const auto&, Image& view) {
          view = makePaper();
          for (std::size_t i = 0; i < view.pixels(); ++i)
            std::fill_n(&view.color[4 * i], 3, std::uint8_t{40}); // all is dark
        });
    // Beside the letters, within a letter's size of them, black can be read.
    std::size_t pale = 0, ink = 0, dark = 0;
    for (std::size_t row = side - 40; row < side; ++row)
      for (std::size_t column = side - 130; column < side; ++column) {
        const std::uint8_t* const pixel = &image.color[4 * (row * side + column)];
        const double white = 255.0 - pixel[3] * (1.0 - pixel[0] / 255.0);
        pale += white > 180.0 ? 1 : 0;
        dark += white > 35.0 && white < 45.0 ? 1 : 0;
        ink += white < 20.0 ? 1 : 0;
      }
    EXPECT_GT(ink, 50u);
    EXPECT_GT(pale, 10u * ink / 2u);
    EXPECT_GT(dark, 500u); // and nothing else has changed
  }
}

TEST(Figure, BoxesHoldWhatCamerasAreFittedTo)
{
  pcl::PointCloud<pcl::PointXYZ> points;
  points.push_back({0.0f, 0.0f, 0.0f});
  points.push_back({1.0f, 2.0f, 3.0f});
  points.push_back({1000.0f, -50.0f, 7.0f}); // isolated
  const pcl_uvol::CloudView cloud = pcl_uvol::viewOf(points);
  uvol_tools::Figure figure;
  figure.has_box = true;
  const auto boxOf = [&](const std::vector<pcl_uvol::FittedDisc>& discs) {
    uvol_tools::Subject subject{cloud, {{500.0, 0.0, 3.0}, 510.0}, {}};
    subject.find_discs = [&](const Camera&, const auto&) { return discs; };
    Eigen::AlignedBox3d seen_box;
    figure.drawViews(
        subject,
        {{}, side, side, side},
        [&](const pcl_uvol::SeenSurface& seen, const auto&) {
          seen_box = uvol_tools::boxAround(*seen.cloud);
          return pcl_uvol::chooseCamera({}, seen, {}, 1.0);
        },
        [](const Camera&, const auto&, Image& view) { view = makePaper(); });
    return std::pair(Vector3d(seen_box.min()), Vector3d(seen_box.max()));
  };
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(std::pair(Vector3d(0, 0, 0), Vector3d(1, 2, 3)),
            boxOf({{1.0f, {}}, {1.0f, {}}, {none, {}}}));
  const std::pair all(Vector3d(0, -50, 0), Vector3d(1000, 2, 7));
  EXPECT_EQ(all, boxOf({}));
  EXPECT_EQ(all, boxOf({{none, {}}, {none, {}}, {none, {}}}));
}

TEST(Lines, CoverWhatIsNearTheirSegment)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(0.0, 40.0);
  for (int i = 0; i < 200; ++i) {
    const double x0 = coordinate(random), y0 = coordinate(random),
                 width = 0.1 * (i % 30);
    // Upright ones, rows and points among them.
    const double x1 = i % 5 == 0 ? x0 : coordinate(random);
    const double y1 = i % 7 == 0 ? y0 : i % 11 == 0 ? y0 + 1e-12 : coordinate(random);
    std::map<std::pair<int, int>, double> covered;
    uvol_tools::forLinePixels(
        x0, y0, x1, y1, width, [&](int column, int row, double part) {
          covered[{column, row}] = part;
        });
    const double dx = x1 - x0, dy = y1 - y0, sq_length = dx * dx + dy * dy;
    for (int row = -5; row < 46; ++row)
      for (int column = -5; column < 46; ++column) {
        const double along =
            sq_length > 0.0
                ? std::clamp(
                      ((column - x0) * dx + (row - y0) * dy) / sq_length, 0.0, 1.0)
                : 0.0;
        const double distance =
            std::hypot(column - x0 - along * dx, row - y0 - along * dy);
        const double part = std::clamp(0.5 * width + 0.5 - distance, 0.0, 1.0);
        const auto found = covered.find({column, row});
        EXPECT_EQ(part, found == covered.end() ? 0.0 : found->second) << i;
      }
  }
}

} // namespace test_view_figures
