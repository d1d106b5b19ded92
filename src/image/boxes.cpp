#include "image/boxes.h"

#include <algorithm>
#include <cmath>

namespace defocus::engine {

double boxDifference(const ImageView& reference, const ImageView& test, int size) {
    const int channels = std::min({3, reference.channels, test.channels});
    double squares = 0;
    std::size_t count = 0;
    for (int top = 0; top + size <= reference.height; top += size)
        for (int left = 0; left + size <= reference.width; left += size)
            for (int c = 0; c < channels; ++c, ++count) {
                double sum = 0;
                for (int y = top; y < top + size; ++y)
                    for (int x = left; x < left + size; ++x)
                        sum += static_cast<double>(test.at(x, y)[c]) - static_cast<double>(reference.at(x, y)[c]);
                const double difference = sum / (static_cast<double>(size) * size);
                squares += difference * difference;
            }
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

}  // namespace defocus::engine
