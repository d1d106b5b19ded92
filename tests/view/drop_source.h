#pragma once
// Drops files on a window of an X server as a file manager does. It implements the source side of XDND version 5
// (freedesktop.org, Drag-and-Drop Protocol for the X Window System).

#include <xcb/xcb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

namespace defocus::engine {

class DropSource {
public:
    explicit DropSource(const std::string& display)
        : connection_(xcb_connect(display.c_str(), nullptr), &xcb_disconnect),
          root_(xcb_setup_roots_iterator(xcb_get_setup(connection_.get())).data->root),
          source_(xcb_generate_id(connection_.get())) {
        xcb_create_window(connection_.get(), XCB_COPY_FROM_PARENT, source_, root_, 0, 0, 1, 1, 0,
                          XCB_WINDOW_CLASS_INPUT_OUTPUT, XCB_COPY_FROM_PARENT, 0, nullptr);
        xcb_set_selection_owner(connection_.get(), source_, atom("XdndSelection"), XCB_CURRENT_TIME);
        xcb_flush(connection_.get());
    }

    // Drops files at the screen position (x, y), which must lie over the only window that accepts drops. `uris`
    // contains file:// URIs, one per line, each ending with CR LF. Returns false if there is no such window, or if the
    // window does not accept the drop within `seconds`.
    bool drop(const std::string& uris, int x, int y, double seconds = 120) {
        uris_ = uris;
        target_ = windowThatTakesDrops();
        if (target_ == XCB_NONE) return false;
        constexpr std::uint32_t version = 5;
        const auto place = static_cast<std::uint32_t>((x << 16) | y);
        send("XdndEnter", {source_, version << 24, atom("text/uri-list"), 0, 0});
        send("XdndPosition", {source_, 0, place, XCB_CURRENT_TIME, atom("XdndActionCopy")});
        if (!answered("XdndStatus", seconds)) return false;
        send("XdndDrop", {source_, 0, XCB_CURRENT_TIME, 0, 0});
        return answered("XdndFinished", seconds);
    }

private:
    template <typename Reply>
    using Answer = std::unique_ptr<Reply, decltype(&std::free)>;

    xcb_atom_t atom(const std::string& name) {
        const auto cookie =
            xcb_intern_atom(connection_.get(), 0, static_cast<std::uint16_t>(name.size()), name.c_str());
        const Answer<xcb_intern_atom_reply_t> reply(xcb_intern_atom_reply(connection_.get(), cookie, nullptr),
                                                    &std::free);
        return reply->atom;
    }

    xcb_window_t windowThatTakesDrops() {
        const Answer<xcb_query_tree_reply_t> tree(
            xcb_query_tree_reply(connection_.get(), xcb_query_tree(connection_.get(), root_), nullptr), &std::free);
        const xcb_window_t* children = xcb_query_tree_children(tree.get());
        for (int i = 0; i < xcb_query_tree_children_length(tree.get()); ++i) {
            const auto cookie =
                xcb_get_property(connection_.get(), 0, children[i], atom("XdndAware"), XCB_GET_PROPERTY_TYPE_ANY, 0, 1);
            const Answer<xcb_get_property_reply_t> aware(xcb_get_property_reply(connection_.get(), cookie, nullptr),
                                                         &std::free);
            if (aware && aware->type != XCB_NONE) return children[i];
        }
        return XCB_NONE;
    }

    void send(const char* message, const std::array<std::uint32_t, 5>& values) {
        xcb_client_message_event_t event{};
        event.response_type = XCB_CLIENT_MESSAGE;
        event.format = 32;
        event.window = target_;
        event.type = atom(message);
        std::copy(values.begin(), values.end(), event.data.data32);
        xcb_send_event(connection_.get(), 0, target_, 0, reinterpret_cast<const char*>(&event));
        xcb_flush(connection_.get());
    }

    // Waits up to `seconds` for a message from the target window. Returns whether the message accepts the drop, that
    // is, whether the second 32-bit value of its data is not 0. Meanwhile, answers the target's requests for the list
    // of files.
    bool answered(const char* message, double seconds) {
        const xcb_atom_t expected = atom(message);
        for (double waited = 0; waited < seconds; waited += 0.01) {
            const Answer<xcb_generic_event_t> event(xcb_poll_for_event(connection_.get()), &std::free);
            if (!event) {
                std::this_thread::sleep_for(std::chrono::milliseconds(10));
                continue;
            }
            const int kind = event->response_type & 0x7f;
            if (kind == XCB_SELECTION_REQUEST)
                giveFiles(*reinterpret_cast<const xcb_selection_request_event_t*>(event.get()));
            const auto* said = reinterpret_cast<const xcb_client_message_event_t*>(event.get());
            if (kind == XCB_CLIENT_MESSAGE && said->type == expected) return said->data.data32[1] != 0;
        }
        return false;
    }

    void giveFiles(const xcb_selection_request_event_t& request) {
        xcb_change_property(connection_.get(), XCB_PROP_MODE_REPLACE, request.requestor, request.property,
                            request.target, 8, static_cast<std::uint32_t>(uris_.size()), uris_.c_str());
        xcb_selection_notify_event_t given{};
        given.response_type = XCB_SELECTION_NOTIFY;
        given.time = request.time;
        given.requestor = request.requestor;
        given.selection = request.selection;
        given.target = request.target;
        given.property = request.property;
        xcb_send_event(connection_.get(), 0, request.requestor, 0, reinterpret_cast<const char*>(&given));
        xcb_flush(connection_.get());
    }

    std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)> connection_;
    xcb_window_t root_;
    xcb_window_t source_;
    xcb_window_t target_ = XCB_NONE;
    std::string uris_;
};

}  // namespace defocus::engine
