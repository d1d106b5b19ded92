#include "view/window/event_pacing.h"

#include <gtest/gtest.h>

#include <string>

namespace defocus::engine {
namespace {

using Type = WindowEvent::Type;

WindowEvent key(int code, bool pressed, bool control = false) {
    WindowEvent event;
    event.type = Type::key;
    event.key = code;
    event.pressed = pressed;
    event.control = control;
    return event;
}
WindowEvent text(char32_t letter) {
    WindowEvent event;
    event.type = Type::text;
    event.letter = letter;
    return event;
}
WindowEvent button(bool pressed, double x) {
    WindowEvent event;
    event.type = Type::button;
    event.pressed = pressed;
    event.position = {x, 10};
    return event;
}

// Returns, for each frame, the number of events that it consumes.
std::vector<std::size_t> frames(std::deque<WindowEvent> queue, bool interfaceHasHand) {
    std::vector<std::size_t> counts;
    const EventPace pace{interfaceHasHand, {100, 100}};
    while (!queue.empty()) counts.push_back(takeEvents(queue, pace).size());
    return counts;
}

using Counts = std::vector<std::size_t>;

const int backspace = 259;

TEST(EventPacing, aChordAndTheTextAfterItAreTwoFrames) {
    const std::deque<WindowEvent> typed = {key(key::leftControl, true),
                                           key('A', true, true),
                                           key('A', false, true),
                                           key(key::leftControl, false),
                                           key('X', true),
                                           text('x'),
                                           key('X', false)};
    EXPECT_EQ(frames(typed, true), (Counts{4, 3}));
}

TEST(EventPacing, keysThatEditStandAlone) {
    const std::deque<WindowEvent> typed = {key('A', true),        text('a'),      key('A', false), key(backspace, true),
                                           key(backspace, false), key('B', true), text('b')};
    EXPECT_EQ(frames(typed, true), (Counts{3, 2, 2}));
}

TEST(EventPacing, aWordIsOneFrameAndADoubledLetterTwo) {
    std::deque<WindowEvent> word;
    for (const char letter : std::string("scene")) {
        word.push_back(key(letter - 'a' + 'A', true));
        word.push_back(text(static_cast<char32_t>(letter)));
        word.push_back(key(letter - 'a' + 'A', false));
    }
    EXPECT_EQ(frames(word, true), (Counts{12, 3}));  // the second letter "e" of "scene" waits for the next frame
}

TEST(EventPacing, whoTakesTheKeysIsKnownAFrameAfterAClick) {
    const std::deque<WindowEvent> hand = {button(true, 150), button(false, 150), key('A', true), text('a')};
    EXPECT_EQ(frames(hand, false), (Counts{1, 1, 2}));
}

TEST(EventPacing, thePictureTakesAllAtOnce) {
    std::deque<WindowEvent> hand = {button(true, 50), button(false, 50), key(']', true),
                                    key(']', false),  key(']', true),    key(']', false)};
    EXPECT_EQ(frames(hand, false), (Counts{6}));
}

TEST(EventPacing, nothingIsLostNorPutOutOfOrder) {
    std::deque<WindowEvent> queue;
    for (int i = 0; i < 200; ++i) {
        const int kind = i * 7919 % 5;
        queue.push_back(kind == 0   ? button(i % 2 == 0, i % 3 * 60)
                        : kind == 1 ? text(static_cast<char32_t>(i))
                                    : key(i * 31 % 400, i % 3 != 0, i % 7 == 0));
        queue.back().scroll.x = i;  // stores the index of the event
    }
    int next = 0;
    while (!queue.empty()) {
        const std::vector<WindowEvent> taken = takeEvents(queue, {next % 2 == 0, {100, 100}});
        ASSERT_FALSE(taken.empty());
        for (const WindowEvent& event : taken) EXPECT_EQ(event.scroll.x, next++);
    }
    EXPECT_EQ(next, 200);
}

}  // namespace
}  // namespace defocus::engine
