// SPDX-License-Identifier: BSD-3-Clause
// Pictures whose letters stay letters.
#include "charts/drawing.h"
#include "charts/picture_file.h"
#include "support/environment.h"
#include <pcl_uvol/common/exceptions.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace test_picture_file {

using namespace uvol_tools;
using pcl_uvol::Image;

Image
makeWhite()
{
  Image image;
  image.width = 120;
  image.height = 60;
  image.color.assign(4 * image.pixels(), 255);
  return image;
}

constexpr Ink red{255, 0, 17};

void
writeLines(Image& image)
{
  writeText(image, "a < b & \"c\"", 12, 100, 20, TextAnchor::Right, red);
  writeUpwards(image, "up", 9, 7, 30, {0, 0, 0});
}

std::string
read(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class PictureFiles : public testing::Test {
protected:
  const uvol_test::TemporaryFolder folder_;
};

TEST_F(PictureFiles, LettersOfSvgAreText)
{
  Image image = makeWhite();
  const std::string path = folder_ / "a.svg";
  {
    const PictureFile file(path);
    writeLines(image);
    file.save(image, {{"Camera", "-eye 1,2,3 <&>"}});
  }
  EXPECT_EQ(makeWhite().color, image.color);
  const std::string svg = read(path);
  for (const char* part :
       {"width=\"120\" height=\"60\" viewBox=\"0 0 120 60\"",
        "<desc>Camera: -eye 1,2,3 &lt;&amp;&gt;\n</desc>",
        "href=\"data:image/png;base64,iVBORw0KGgo",
        "<text font-size=\"12\" text-anchor=\"end\" fill=\"#ff0011\" "
        "transform=\"translate(100.5 20.5)\" y=\"4.2\">a &lt; b "
        "&amp; &quot;c&quot;</text>",
        "<text font-size=\"9\" text-anchor=\"middle\" "
        "fill=\"#000000\" transform=\"translate(7.5 30.5) "
        "rotate(-90)\" y=\"3.15\">up</text>",
        "</svg>\n"})
    EXPECT_NE(std::string::npos, svg.find(part)) << part << '\n' << svg;
}

TEST_F(PictureFiles, LettersOfPdfAreTextInFontsOfItsOwn)
{
  const auto write = [&](const std::string& name, double dots_per_inch) {
    Image image = makeWhite();
    const PictureFile file(folder_ / name, dots_per_inch);
    writeLines(image);
    file.save(image, {{"Camera", "-eye 1,2,3"}, {"Isovalue", "4"}});
    EXPECT_EQ(makeWhite().color, image.color);
    return read(folder_ / name);
  };
  const std::string pdf = write("a.pdf", 300.0);
  EXPECT_EQ(0u, pdf.find("%PDF-"));
  // 120 x 60 pixels in points.
  for (const char* part : {"/MediaBox [ 0 0 28.8 14.4 ]",
                           "/FontFile",
                           "/Subtype /Image",
                           "/Subject (Camera: -eye 1,2,3; Isovalue: 4)"})
    EXPECT_NE(std::string::npos, pdf.find(part)) << part << '\n' << pdf;
  EXPECT_EQ(std::string::npos, pdf.find("Date"));
  EXPECT_EQ(pdf, write("b.pdf", 300.0));
  EXPECT_NE(std::string::npos, write("c.pdf", 0.0).find("/MediaBox [ 0 0 90 45 ]"));
}

TEST_F(PictureFiles, LettersOfPngArePixels)
{
  Image image = makeWhite();
  const PictureFile file(folder_ / "a.png");
  writeLines(image);
  file.save(image);
  EXPECT_NE(makeWhite().color, image.color);
  EXPECT_EQ(0u, read(folder_ / "a.png").find("\x89PNG"));
}

TEST_F(PictureFiles, TextIsAsWideEitherWay)
{
  Image image = makeWhite();
  const int drawn = writeText(image, "1234", 14, 5, 20, TextAnchor::Left, red);
  const TextKeeper outer;
  {
    const TextKeeper inner;
    EXPECT_EQ(drawn, writeText(image, "1234", 14, 5, 20, TextAnchor::Left, red));
    EXPECT_EQ(1u, inner.getLines().size());
  }
  writeText(image, "5", 14, 5, 20, TextAnchor::Left, red);
  ASSERT_EQ(1u, outer.getLines().size());
  EXPECT_EQ("5", outer.getLines()[0].text);
}

TEST_F(PictureFiles, OtherEndingsAndFoldersAreRefused)
{
  checkPicturePath(folder_ / "a.svg");
  checkPicturePath(folder_ / "a.PNG");
  for (const bool or_page : {false, true})
    try {
      (or_page ? checkDrawingPath : checkPicturePath)(folder_ / "a.gif");
      ADD_FAILURE();
    }
    catch (const pcl_uvol::IOError& error) {
      EXPECT_EQ(or_page, std::string(error.what()).find(".html") != std::string::npos);
    }
  EXPECT_THROW(checkPicturePath(folder_ / "missing/a.svg"), pcl_uvol::IOError);
  EXPECT_THROW(checkPicturePath(folder_ / "missing/a.png"), pcl_uvol::IOError);
  EXPECT_EQ("", encodeBase64("", 0));
  EXPECT_EQ("Zg==", encodeBase64("foobar", 1)); // RFC 4648, section 10
  EXPECT_EQ("Zm9vYg==", encodeBase64("foobar", 4));
  EXPECT_EQ("Zm9vYmFy", encodeBase64("foobar", 6));
  EXPECT_EQ("+/8=", encodeBase64("\xfb\xff", 2));
  EXPECT_EQ("AAECAwQ=", encodeBase64("\0\1\2\3\4", 5));
}

} // namespace test_picture_file
