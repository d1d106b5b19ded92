// Checks that each image has the given size and is not empty, and that all images have the same pixels. The program
// links the installed library, as the examples do. Usage: check WIDTH HEIGHT CHANNELS IMAGE...

#include <defocus/defocus.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

int main(int count, char** words) try {
    defocus::Image first;
    for (int i = 4; i < count; ++i) {
        const defocus::Image image = defocus::readImage(words[i]);
        const auto [min, max] = std::minmax_element(image.pixels.begin(), image.pixels.end());
        const bool sized = image.width == std::atoi(words[1]) && image.height == std::atoi(words[2]) &&
                           image.channels == std::atoi(words[3]);
        const bool same = first.empty() || image.pixels == first.pixels;
        if (!sized || !same || !(*min < *max)) {
            std::cerr << words[i] << ": " << image.width << "x" << image.height << "x" << image.channels << ", from "
                      << *min << " to " << *max << (same ? "" : ", other pixels than the first") << '\n';
            return 1;
        }
        if (first.empty()) first = image;
    }
    return first.empty() ? 1 : 0;
} catch (const defocus::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
