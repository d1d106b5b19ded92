// progressive [SCENE [IMAGE]]: renders an image in steps and writes the image after each step; Ctrl-C ends the
// rendering early and keeps the latest image. Also writes the depth of each pixel.

#include <defocus/defocus.h>

#include <csignal>
#include <filesystem>
#include <iostream>

namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

int main(int count, char** words) try {
    std::signal(SIGINT, [](int) { interrupted = 1; });
    const std::filesystem::path output = count > 2 ? words[2] : "out.png";

    defocus::Request request;
    if (count > 1) request.scene = words[1];
    request.size = {480, 270};
    request.toneMap = defocus::ToneMap::agx;
    request.wave = 8;  // lens samples per step

    defocus::SceneRenderer renderer(request);
    for (const std::string& line : renderer.warnings()) std::cerr << line << '\n';
    renderer.start();
    while (renderer.advance() && interrupted == 0) {
        renderer.write(output, renderer.image());
        std::cout << renderer.samples() << " of " << renderer.sampleTotal() << " samples\n";
    }
    renderer.write(output, renderer.image());
    defocus::writeImage(std::filesystem::path(output).replace_extension("depth.exr"), renderer.aovs().depth);

    const defocus::RenderStatistics statistics = renderer.statistics();
    std::cout << statistics.samples << " samples in " << statistics.renderMilliseconds << " ms on " << statistics.device
              << '\n';
} catch (const defocus::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
