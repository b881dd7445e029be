// SPDX-License-Identifier: BSD-3-Clause
// Contexts without a window. Mesa is a part of every test machine: nothing is skipped.
#include "gl/context.h"
#include "gl/gl_backend.h"
#include "support/messages.h"

#include <atomic>
#include <gmock/gmock.h>
#include <stdexcept>
#include <thread>
#include <vector>

namespace test_gl_context {

using pcl_uvol::EglDevice;
using pcl_uvol::GlContext;
using pcl_uvol::GlError;
using testing::HasSubstr;

using ContextPtr = std::shared_ptr<GlContext>;

/** Every kind of context that does not need special hardware. */
class GlContextOfEveryKind : public testing::TestWithParam<std::string> {
protected:
  static ContextPtr
  create()
  {
    return GetParam() == "osmesa" ? pcl_uvol::createOsMesaContext()
                                  : pcl_uvol::createEglContext(EglDevice::Software);
  }
};

INSTANTIATE_TEST_SUITE_P(GlContext,
                         GlContextOfEveryKind,
                         testing::Values("osmesa", "egl"),
                         [](const auto& name) { return name.param; });

/** The version of the context that is current, as major * 10 + minor. */
int
currentVersion(const GlContext& context)
{
  const auto get_integer =
      reinterpret_cast<void (*)(unsigned, int*)>(context.getFunction("glGetIntegerv"));
  constexpr unsigned major_version = 0x821b, minor_version = 0x821c;
  int major = 0, minor = 0;
  get_integer(major_version, &major);
  get_integer(minor_version, &minor);
  return 10 * major + minor;
}

/** What glClearColor was last called with: a state that contexts must not share. */
float
clearedRed(const GlContext& context)
{
  const auto get_float =
      reinterpret_cast<void (*)(unsigned, float*)>(context.getFunction("glGetFloatv"));
  constexpr unsigned color_clear_value = 0x0c22;
  float color[4] = {-1.0f, -1.0f, -1.0f, -1.0f};
  get_float(color_clear_value, color);
  return color[0];
}

void
clearWithRed(const GlContext& context, float red)
{
  reinterpret_cast<void (*)(float, float, float, float)>(
      context.getFunction("glClearColor"))(red, 0.0f, 0.0f, 0.0f);
}

TEST_P(GlContextOfEveryKind, IsNewEnoughAndSaysWhatItIs)
{
  const ContextPtr context = create();
  EXPECT_EQ(GetParam(), context->getName());
  EXPECT_THAT(context->getVersion(), HasSubstr("Core"));
  EXPECT_FALSE(context->getRenderer().empty());
  int version = 0;
  context->run([&] { version = currentVersion(*context); });
  EXPECT_GE(version, 33);
}

TEST_P(GlContextOfEveryKind, MesaIsSoftware)
{
  EXPECT_FALSE(create()->isHardware());
}

TEST_P(GlContextOfEveryKind, AgainAndAgain)
{
  for (int i = 0; i < 3; ++i) {
    const ContextPtr context = create();
    int version = 0;
    context->run([&] { version = currentVersion(*context); });
    EXPECT_GE(version, 33) << "context " << i;
  }
}

TEST_P(GlContextOfEveryKind, ExceptionsReachTheCaller)
{
  const ContextPtr context = create();
  EXPECT_THROW(context->run([] { throw std::out_of_range("from the task"); }),
               std::out_of_range);
  bool ran = false;
  context->run([&] { ran = true; });
  EXPECT_TRUE(ran);
}

TEST_P(GlContextOfEveryKind, ATaskMayRunAnother)
{
  const ContextPtr context = create();
  int version = 0;
  context->run([&] { context->run([&] { version = currentVersion(*context); }); });
  EXPECT_GE(version, 33);
}

TEST_P(GlContextOfEveryKind, TasksOfManyThreadsRunOneByOne)
{
  const ContextPtr context = create();
  std::atomic<int> running{0}, overlaps{0}, done{0};
  std::thread threads[8];
  for (std::thread& thread : threads)
    thread = std::thread([&] {
      for (int j = 0; j < 50; ++j)
        context->run([&] {
          overlaps += running++ > 0;
          done += currentVersion(*context) >= 33;
          --running;
        });
    });
  for (std::thread& thread : threads)
    thread.join();
  EXPECT_EQ(0, overlaps);
  EXPECT_EQ(400, done);
}

TEST_P(GlContextOfEveryKind, IsFoundWhereItIsCurrent)
{
  const ContextPtr other = GetParam() == "osmesa"
                               ? pcl_uvol::createEglContext(EglDevice::Software)
                               : pcl_uvol::createOsMesaContext();
  const ContextPtr context = create();
  context->run([&] {
    const ContextPtr found = pcl_uvol::wrapCurrentContext("window");
    EXPECT_EQ("window", found->getName());
    EXPECT_EQ(context->getVersion(), found->getVersion());
    EXPECT_EQ(context->getRenderer(), found->getRenderer());
    clearWithRed(*found, 0.375f);
    EXPECT_EQ(0.375f, clearedRed(*context));
    EXPECT_NE(nullptr, found->getFunction("glTexBuffer"));
  });
}

TEST_P(GlContextOfEveryKind, UnknownFunctionsHaveNoEffectOnKnownOnes)
{
  const ContextPtr context = create();
  context->getFunction("glNoSuchFunctionAtAll");
  EXPECT_NE(nullptr, context->getFunction("glDrawArrays"));
}

TEST(GlContext, TwoSideBySide)
{
  const std::vector<ContextPtr> contexts = {
      pcl_uvol::createOsMesaContext(),
      pcl_uvol::createEglContext(EglDevice::Software),
      pcl_uvol::createOsMesaContext(),
      pcl_uvol::createEglContext(EglDevice::Software)};
  for (std::size_t i = 0; i < contexts.size(); ++i)
    contexts[i]->run(
        [&] { clearWithRed(*contexts[i], 0.125f * static_cast<float>(i)); });
  for (std::size_t i = 0; i < contexts.size(); ++i)
    contexts[i]->run(
        [&] { EXPECT_EQ(0.125f * static_cast<float>(i), clearedRed(*contexts[i])); });
}

TEST(GlContext, TheOthersLiveOn)
{
  const ContextPtr stays = pcl_uvol::createEglContext(EglDevice::Software);
  pcl_uvol::createEglContext(EglDevice::Software).reset();
  int version = 0;
  stays->run([&] { version = currentVersion(*stays); });
  EXPECT_GE(version, 33);
}

/** The message of the GlError that a task throws. */
template <typename Task>
std::string
messageOf(const Task& task)
{
  const auto error = uvol_test::thrownBy<GlError>(task);
  EXPECT_NE("", error.code);
  return error.text();
}

TEST(GlContext, AMissingLibrarySaysWhatToDo)
{
  EXPECT_THAT(messageOf([] { pcl_uvol::createOsMesaContext("libNoMesa.so.1"); }),
              testing::AllOf(HasSubstr("libNoMesa.so.1"), HasSubstr("libosmesa6")));
  EXPECT_THAT(
      messageOf([] { pcl_uvol::createEglContext(EglDevice::Any, "libNoEgl.so.1"); }),
      testing::AllOf(HasSubstr("libNoEgl.so.1"), HasSubstr("libegl1")));
}

TEST(GlContext, AnotherLibraryIsNoneOfOpenGl)
{
  EXPECT_THAT(messageOf([] { pcl_uvol::createOsMesaContext("libm.so.6"); }),
              HasSubstr("OSMesa"));
  EXPECT_THAT(
      messageOf([] { pcl_uvol::createEglContext(EglDevice::Any, "libm.so.6"); }),
      HasSubstr("egl"));
}

TEST(GlContext, HardwareIsEitherThereOrNull)
{
  const ContextPtr context = pcl_uvol::findHardwareContext();
  if (context)
    EXPECT_TRUE(context->isHardware());
  else
    EXPECT_THROW(pcl_uvol::createEglContext(EglDevice::Hardware), GlError);
}

TEST(GlContext, CardsAreCountedFrom0)
{
  const ContextPtr any = pcl_uvol::findHardwareContext();
  const auto create = [](int card) {
    return pcl_uvol::createHeadlessContext("egl", card);
  };
  if (any)
    EXPECT_EQ(any->getRenderer(), create(0)->getRenderer());
  else // not in software
    EXPECT_EQ("egl_without_context", uvol_test::codeOf<GlError>([&] { create(0); }));
  const auto error = uvol_test::thrownBy<GlError>([&] { create(999); });
  EXPECT_EQ("egl_without_context", error.code);
  EXPECT_EQ(999.0, uvol_test::numberOf(error, "card"));
  EXPECT_THROW(pcl_uvol::createHeadlessContext("osmesa", 0), pcl_uvol::InvalidArgument);
}

TEST(GlContext, ByName)
{
  EXPECT_EQ("osmesa", pcl_uvol::createHeadlessContext("osmesa")->getName());
  EXPECT_EQ("egl", pcl_uvol::createHeadlessContext("egl")->getName());
  EXPECT_THROW(pcl_uvol::createHeadlessContext("glx"), pcl_uvol::InvalidArgument);
}

TEST(GlContext, SomebodyElsesRunsOnTheCallersThread)
{
  const ContextPtr owner = pcl_uvol::createOsMesaContext();
  owner->run([&] {
    const auto find = [&](const char* name) { return owner->getFunction(name); };
    const ContextPtr wrapped = pcl_uvol::wrapCurrentContext("window", find);
    EXPECT_EQ("window", wrapped->getName());
    EXPECT_EQ(owner->getVersion(), wrapped->getVersion());
    EXPECT_EQ(owner->getRenderer(), wrapped->getRenderer());
    std::thread::id thread;
    wrapped->run([&] { thread = std::this_thread::get_id(); });
    EXPECT_EQ(std::this_thread::get_id(), thread);
  });
}

TEST(GlContext, NoCurrentContextIsAnError)
{
  const auto find_none = [](const char*) -> GlContext::Function { return nullptr; };
  EXPECT_THAT(messageOf([&] { pcl_uvol::wrapCurrentContext("window", find_none); }),
              HasSubstr("window"));
  const ContextPtr elsewhere = pcl_uvol::createOsMesaContext();
  EXPECT_EQ(
      pcl_uvol::Message("gl_no_current_context", {{"context", "window"}}),
      uvol_test::thrownBy<GlError>([] { pcl_uvol::wrapCurrentContext("window"); }));
}

/** A context that has forgotten one function. */
TEST(GlContext, AMissingFunctionIsNamed)
{
  const ContextPtr owner = pcl_uvol::createOsMesaContext();
  owner->run([&] {
    const auto find = [&](const char* name) -> GlContext::Function {
      return std::string(name) == "glTexBuffer" ? nullptr : owner->getFunction(name);
    };
    const ContextPtr wrapped = pcl_uvol::wrapCurrentContext("window", find);
    EXPECT_THAT(messageOf([&] { pcl_uvol::GlBackend backend(wrapped); }),
                HasSubstr("glTexBuffer"));
  });
}

} // namespace test_gl_context
