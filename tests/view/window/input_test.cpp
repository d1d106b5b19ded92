#include "view/window/input.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace defocus::engine {
namespace {

class ViewInputKeys : public testing::Test {
protected:
    void key(int code, bool pressed, bool control = false) {
        WindowEvent event;
        event.type = WindowEvent::Type::key;
        event.key = code;
        event.pressed = pressed;
        event.control = control;
        input.handle(event, context, state, actions);
    }
    // Returns the distance that the camera moves in 0.1 s.
    double flown() {
        const glm::dvec3 before = state.camera.position();
        input.fly(context, 0.1, state);
        return glm::length(state.camera.position() - before);
    }

    ViewInput input;
    InputContext context;
    ViewState state;
    ViewActions actions;
};

TEST_F(ViewInputKeys, flyWhileTheyAreHeld) {
    EXPECT_EQ(flown(), 0);
    key('W', true);
    const double slow = flown();
    EXPECT_GT(slow, 0);
    key(key::leftShift, true);
    EXPECT_NEAR(flown(), 4 * slow, 1e-12 * slow);
    key(key::leftShift, false);
    key('S', true);  // W and S cancel out
    EXPECT_EQ(flown(), 0);
    key('S', false);
    EXPECT_NEAR(flown(), slow, 1e-12 * slow);
    key('W', false);
    EXPECT_EQ(flown(), 0);
}

// Keys of a keyboard shortcut do not move the camera, even if Ctrl is released before the other key. Otherwise the
// camera could move by some millimetres before an image is exported, depending on when a frame reads the keyboard.
TEST_F(ViewInputKeys, commandsDontFlyWhicheverKeyIsLetGoFirst) {
    key(key::leftControl, true);
    key('E', true, true);
    EXPECT_TRUE(actions.askExport);
    EXPECT_EQ(flown(), 0);
    key(key::leftControl, false, true);
    EXPECT_EQ(flown(), 0);
    key('E', false);
    EXPECT_EQ(flown(), 0);
    key('E', true);
    EXPECT_GT(flown(), 0);
}

TEST_F(ViewInputKeys, typingDoesNotFly) {
    key('W', true);
    context.typing = true;
    EXPECT_EQ(flown(), 0);
    key('D', true);
    key('W', false);
    context.typing = false;
    EXPECT_EQ(flown(), 0);
}

}  // namespace
}  // namespace defocus::engine
