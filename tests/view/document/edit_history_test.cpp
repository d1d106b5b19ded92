#include "view/document/edit_history.h"

#include <gtest/gtest.h>

namespace defocus::engine {
namespace {

class ViewHistory : public testing::Test {
protected:
    void SetUp() override { history.begin(now); }
    // Records a frame with this f-number, `seconds` after the previous frame. `held` is true while a mouse button is
    // down.
    void frame(double fStop, bool held = false, double seconds = 0.02) {
        now.lens.fStop = fStop;
        clock += seconds;
        history.note(now, held, clock);
    }
    double undone() {
        const auto edit = history.undo(now);
        if (edit) now = *edit;
        return now.lens.fStop;
    }
    double redone() {
        const auto edit = history.redo(now);
        if (edit) now = *edit;
        return now.lens.fStop;
    }

    ViewEdit now;
    EditHistory history;
    double clock = 0;
    const double opened = Lens{}.fStop;
};

TEST_F(ViewHistory, aDragIsOneStep) {
    for (const double stop : {3.0, 4.0, 5.0}) frame(stop, true);
    frame(5);
    EXPECT_EQ(history.undoSteps(), 1u);
    EXPECT_EQ(undone(), opened);
    EXPECT_EQ(redone(), 5);
}

TEST_F(ViewHistory, dragsAfterEachOtherAreSteps) {
    for (const double stop : {3.0, 4.0, 5.0}) {
        frame(stop, true);
        frame(stop);
    }
    EXPECT_EQ(history.undoSteps(), 3u);
    EXPECT_EQ(undone(), 4);
    EXPECT_EQ(undone(), 3);
    EXPECT_EQ(undone(), opened);
    EXPECT_EQ(undone(), opened);  // the first state; there is no earlier step to undo
    EXPECT_EQ(redone(), 3);
}

TEST_F(ViewHistory, notchesOfAWheelAreOneStepOnceItRests) {
    for (const double stop : {3.0, 4.0, 5.0}) frame(stop, false, 0.1);
    EXPECT_EQ(history.undoSteps(), 1u);  // all notches are one undo step until the wheel stops
    frame(5, false, 0.6);
    frame(6, false, 0.6);
    frame(6, false, 0.6);
    EXPECT_EQ(history.undoSteps(), 2u);
    EXPECT_EQ(undone(), 5);
    EXPECT_EQ(undone(), opened);
}

TEST_F(ViewHistory, aHandThatTakesHoldEndsWhatTheWheelDid) {
    frame(3);
    frame(3, true);
    frame(4, true);
    frame(4);
    EXPECT_EQ(undone(), 3);
    EXPECT_EQ(undone(), opened);
}

TEST_F(ViewHistory, undoTakesWhatIsStillUnderWay) {
    frame(3);
    EXPECT_EQ(undone(), opened);
    EXPECT_EQ(redone(), 3);
}

TEST_F(ViewHistory, aNewEditForgetsWhatWasUndone) {
    frame(3, true);
    frame(3);
    undone();
    frame(9, true);
    frame(9);
    EXPECT_EQ(history.redoSteps(), 0u);
    EXPECT_EQ(undone(), opened);
    EXPECT_EQ(redone(), 9);
}

TEST_F(ViewHistory, resetIsAStepThatCanBeUndone) {
    EXPECT_FALSE(history.reset(now));
    frame(3, true);
    frame(3);
    now = history.reset(now).value();
    EXPECT_EQ(now.lens.fStop, opened);
    EXPECT_EQ(undone(), 3);
}

TEST_F(ViewHistory, timeAndTheWayOfACameraThatIsFollowedAreNoEdits) {
    ViewEdit other = now;
    other.options.time = 3;
    EXPECT_TRUE(sameEdit(now, other));
    other.camera.worldFromCamera[3].x += 1;
    EXPECT_FALSE(sameEdit(now, other));
    now.followsCamera = other.followsCamera = true;
    EXPECT_TRUE(sameEdit(now, other));
    other.options.hide = {"a"};
    EXPECT_FALSE(sameEdit(now, other));
    other = now;
    other.meters = now.meters = true;
    other.exposure += 1;
    EXPECT_TRUE(sameEdit(now, other));
    now.meters = false;
    EXPECT_FALSE(sameEdit(now, other));
}

}  // namespace
}  // namespace defocus::engine
