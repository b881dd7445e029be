// SPDX-License-Identifier: BSD-3-Clause
// Mistakes in scenes: each is told with its place.
#include "scene_text.h"

#include <algorithm>

using namespace pcl_uvol;
using namespace uvol_test;

namespace test_scene_errors {

class SceneErrors : public SceneText {
protected:
  /** What follows the name of the scene in the error. */
  std::string
  errorOf(const std::string& text)
  {
    const std::string message = messageOf<IOError>([&] { load(text); });
    EXPECT_EQ(message.find(path_ + ":"), 0u) << text << " gives " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_TRUE(!message.empty() && message.back() == '.') << message;
    return message.substr(std::min(message.size(), path_.size() + 1));
  }

  /** \param start of the error: line, column and words */
  void
  expectError(const std::string& text, const std::string& start)
  {
    const std::string error = errorOf(text);
    EXPECT_EQ(error.find(start), 0u) << text << " gives " << error;
  }
};

TEST_F(SceneErrors, WordsThatAreNotKnownOrTooMany)
{
  expectError("spehre 0 0 0 1",
              "1:1: unknown word 'spehre'; items are size, camera, background, depth, "
              "supersampling, shadows, light-samples, occlusion, light, material, "
              "cloud, sphere, plane, include.");
  expectError("Sphere 0 0 0 1", "1:1: unknown word 'Sphere'");
  expectError("\n# c\n  sphere 0 0 0 1 colour 1",
              "3:18: unknown word 'colour'; options of sphere are material NAME.");
  expectError("light lamp 0 0 1", "1:7: unknown word 'lamp'; lights are point, ");
  expectError("shadows yes", "1:9: 'yes' is neither on nor off");
  expectError("size 10 20 30", "1:12: unexpected word '30'; write 'size W H'.");
  expectError("background transparent 1", "1:24: unexpected word '1'");
  expectError("include a.txt b.txt", "1:15: unexpected word 'b.txt'");
  expectError("light point 0 0 1 radius 1 radius 2", "1:28: 'radius' is given twice.");
  expectError("cloud a.ply scale 2 fit 0 0 0 1",
              "1:21: 'fit' and 'scale' do not go together.");
  expectError("cloud a.ply fit 0 0 0 1 at 0 0 0",
              "1:25: 'fit' and 'at' do not go together.");
  expectError("cloud a.ply delta 1 delta-abs 1",
              "1:21: 'delta' and 'delta-abs' do not go together.");
  expectError("cloud a.ply colormap gray",
              "1:1: colormap and range need 'color FIELD'");
  expectError("cloud a.ply color rgb range 0 1", "1:1: colormap and range need");
  expectError("cloud a.ply color x colormap jet", "1:30: ");
  expectError("cloud a.ply color x colormap jet\xec",
              "1:30: There is no colour map 'jet\\xec'");
}

TEST_F(SceneErrors, NumbersThatAreMissingMalformedOrOutOfRange)
{
  expectError("sphere 0 0 1",
              "1:13: a number above 0 is missing; write 'sphere x y z RADIUS'.");
  expectError("sphere 0 0 1 # 2", "1:13: a number above 0 is missing");
  expectError("sphere 0 0 0 1 material", "1:24: the name of a material is missing");
  expectError("size", "1:5: a whole number from 1 to 16384 is missing");
  for (const char* const word :
       {"1.5m", "nan", "-inf", "INFINITY", "1e999", "0x10", "1,5", "--1", "x"})
    expectError("sphere 0 " + std::string(word) + " 0 1",
                "1:10: '" + std::string(word) +
                    "' is not a number; write 'sphere x y z RADIUS'.");
  expectError("camera eye 1 0 0 at 1 x 0",
              "1:23: 'x' is not a number; write 'at x y z'.");
  expectError("sphere 0 1e31 0 1", "1:10: '1e31' is farther from 0 than 1e30");
  for (const auto& [text, error] : std::vector<std::pair<const char*, const char*>>{
           {"size 0 10", "1:6: '0' is not a whole number from 1 to 16384"},
           {"size 10 16385", "1:9: '16385' is not a whole"},
           {"size 10.5 1", "1:6: '10.5' is not a whole"},
           {"depth -1", "1:7: '-1' is not a whole number from 0 to 10000"},
           {"supersampling 9", "1:15: '9' is not a whole number from 1 to 8"},
           {"light-samples 0", "1:15: '0' is not a whole number from 1 to 4096"},
           {"occlusion 4097", "1:11: '4097' is not a whole number from 0 to 4096"},
           {"occlusion 1 distance 0", "1:22: '0' is not a number above 0"},
           {"background 0 -1 0", "1:14: '-1' is not a number of at least 0"},
           {"background blue", "1:12: 'blue' is not a number of at least 0"},
           {"sphere 0 0 0 0", "1:14: '0' is not a number above 0"},
           {"plane 0 0 0 0 0 0", "1:13: a direction has a length above 0"},
           {"plane 0 0 0 0 0 1 checker 0 1 1 1", "1:27: '0' is not a number above 0"},
           {"light directional 0 0 0", "1:19: a direction has"},
           {"light point 0 0 0 radius -1", "1:26: '-1' is not"},
           {"material m reflect 1.5", "1:20: '1.5' is not a number from 0 to 1"},
           {"material m reflect 0.5 transparent 0.6",
            "1:10: the material 'm' reflects"},
           {"material m index 0", "1:18: '0' is not a number above 0"},
           {"material m ambient -1", "1:20: '-1' is not a number of at least 0"},
           {"cloud a.ply fit 0 0 0 0", "1:23: '0' is not a number above 0"},
           {"cloud a.ply turn 0 0 0 90", "1:18: a direction has"},
           {"cloud a.ply scale -1", "1:19: '-1' is not a number above 0"},
           {"cloud a.ply delta 0", "1:19: '0' is not a number above 0"},
           {"cloud a.ply delta-abs 0", "1:23: '0' is not a number above 0"},
           {"cloud a.ply lambda 2", "1:20: '2' is not a number from 0 to 1"},
           {"cloud a.ply range 2 1", "1:21: the high end of a range"}})
    expectError(text, error);
}

TEST_F(SceneErrors, CamerasThatSeeNothing)
{
  expectError("camera eye 1 1 1 fov 20", "1:1: a camera needs 'eye x y z' and");
  expectError("camera eye 1 1 1 at 1 1 1", "1:1: ");
  expectError("camera eye 0 0 1 at 0 0 0", "1:1: ");
  expectError("camera eye 0 0 1 at 0 0 0 up 0 0 0", "1:30: a direction has");
  expectError("camera eye 1 0 0 at 0 0 0 fov 180",
              "1:31: '180' is not a number between 0 and 180");
}

TEST_F(SceneErrors, MaterialsAreDefinedOnceAndBeforeTheirUse)
{
  expectError("sphere 0 0 0 1 material c\nmaterial c",
              "1:25: unknown material 'c'; none is defined in front of this line.");
  expectError("material a\nmaterial b\nsphere 0 0 0 1 material c",
              "3:25: unknown material 'c'; known ones are a, b.");
  expectError("material a\nmaterial a",
              "2:10: the material 'a' is defined already, at " + path_ + ":1:10.");
}

TEST_F(SceneErrors, QuotesAndWhatIsNoText)
{
  expectError("cloud \"my file.ply", "1:7: this quote does not end.");
  expectError("cloud \"a\"b", "1:10: a blank is missing behind the quote.");
  expectError("cloud \"\"", "1:7: there is nothing between the quotes");
  const std::string word(2000, 'a');
  const std::string error = errorOf("size 1 1\n" + word + " 1");
  EXPECT_EQ(error.find("2:1: unknown word '" + word.substr(0, 40) + "...'; items"), 0u);
  EXPECT_LT(error.size(), 300u);
  expectError("size 1 1\n" + std::string(20000, 'a'), "2:1: this line has 20000");
  std::string umlauts;
  for (int i = 0; i < 40; ++i)
    umlauts += "\xC3\xA4";
  expectError("a" + umlauts, "1:1: unknown word 'a" + umlauts.substr(0, 78) + "...'");
  for (const char* const text : {"size 1 1\n\x01", "sphere\n1\x1b[2J", "a\n\x0c"}) {
    const std::string message = messageOf<IOError>([&] { load(text); });
    EXPECT_EQ(
        message.find("Cannot read '" + path_ + "', line 2: it is not a text file"), 0u)
        << message;
  }
}

TEST_F(SceneErrors, FilesThatAreMissingOrGoRound)
{
  EXPECT_EQ(messageOf<IOError>([&] { loadScene(folder_ / "no.txt", "", 1, report_); }),
            "Cannot read '" + (folder_ / "no.txt") + "': there is no such file.");
  EXPECT_EQ(errorOf("size 1 1\n cloud no.ply"),
            "2:2: Cannot read '" + (folder_ / "no.ply") + "': there is no such file.");
  EXPECT_EQ(errorOf("include no.txt"),
            "1:9: Cannot read '" + (folder_ / "no.txt") + "': there is no such file.");
  EXPECT_EQ(errorOf("include scene.txt"),
            "1:9: a file includes itself: " + path_ + " -> " + path_ + ".");
  const std::string other = folder_ / "other.txt";
  writeFile(other, "size 1 1\n\ninclude ./scene.txt");
  EXPECT_EQ(messageOf<IOError>([&] { load("include other.txt"); }),
            other + ":3:9: a file includes itself: " + path_ + " -> " + other + " -> " +
                (folder_ / "./scene.txt") + ".");
  writeFile(other, "sphere 0 0 0 1\ndepth x");
  const std::string message = messageOf<IOError>([&] { load("include other.txt"); });
  EXPECT_EQ(message.find(other + ":2:7: 'x' is not"), 0u) << message;
  EXPECT_NE(messageOf<IOError>([&] { load(""); }).find("the file is empty"),
            std::string::npos);
}

TEST_F(SceneErrors, ScenesThatDrawNothing)
{
  for (const char* const text : {"# nothing\n", "size 1 1\nlight point 0 0 1\n"})
    EXPECT_EQ(messageOf<IOError>([&] { load(text); }),
              "The scene '" + path_ + "' is empty: it has no cloud, sphere or plane.");
}

TEST_F(SceneErrors, CloudsThatCannotBeDrawn)
{
  writeFile(folder_ / "nan.csv", "x,y,z\nnan,0,0\nnan,1,0\n");
  expectError("size 1 1\n cloud nan.csv", "2:2: ");
  writeFile(folder_ / "bad.csv", splatTable("", {"!", "!"}));
  expectError("cloud bad.csv", "1:1: no splat of 'bad.csv' is usable.");
  writeFile(folder_ / "one.csv", splatTable(",value", {",1"}));
  expectError("cloud one.csv fit 0 0 0 1", "1:1: all points of 'one.csv' are at one");
  expectError("cloud one.csv scale 1e-30 scale 1", "1:27: 'scale' is given twice.");
  writeFile(folder_ / "two.csv", splatTable(",value", {",1", ",nan"}));
  expectError("cloud two.csv color q", "1:21: There is no field 'q'");
  expectError("cloud two.csv color rgb", "1:21: The cloud has no colours");
  std::string tiny = splatTable("", {"", ""});
  tiny.replace(tiny.find("0.5"), 3, "1e-20");
  writeFile(folder_ / "tiny.csv", tiny);
  expectError("cloud tiny.csv scale 1e-30", "1:1: a splat of 'tiny.csv' becomes");
}

} // namespace test_scene_errors
