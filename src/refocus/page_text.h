#pragma once

#include <string_view>

namespace defocus::engine {

// Text of page.html, embedded at build time. @PAGE_TITLE@, @PAGE_DATA@ and @PAGE_TONE_MAP@ are placeholders that
// refocusPage() fills in.
extern const std::string_view refocusPageText;

}  // namespace defocus::engine
