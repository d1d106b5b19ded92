#include "school/prototypes.h"

namespace defocus::engine::prototypes {

// ---- species of long swimmers ----------------------------------------------------------------------

Fish fusilier(int variant) {
    Fish fish{.species = "Fusilier", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .045f, .098f, .142f, .16f, .15f, .115f, .068f, .042f},
                 {0, .045f, .09f, .13f, .15f, .142f, .108f, .062f, .04f},
                 {0, .042f, .076f, .10f, .11f, .10f, .076f, .042f, .022f}};
    s.medianFins = {{FinKind::dorsal, .3f, .88f, {.05f, .12f, .09f, .07f, .055f, .03f}, .6f, 1.05f, .15f, .1f, 20},
                    {FinKind::anal, .58f, .88f, {.03f, .09f, .085f, .065f, .05f, .03f}, .65f, 1.05f, .15f, .05f, 11}};
    s.caudal = {.31f, .62f, .66f, .0f, 20};
    s.pectoral = {FinKind::pectoral, .27f, -.05f, .236f, .7f, .4f, .3f, .04f, 12};
    s.pelvic = {FinKind::pelvic, .34f, -.85f, .146f, .4f, .2f, .5f, .025f, 7};
    s.eyeRadius = .034f;
    s.gillA = .25f;
    s.scaleSize = .036f;
    FishPattern& p = fish.pattern;
    if (variant % 2 == 0) {  // palette: steel blue under a golden back
        setBody(p, 0xffc21a, 0x2f8fe0, 0xdff2ff);
        p.rear = rgb(0xffc21a);
        p.rearStart = .8f;
        p.rearSoftness = .16f;
        p.rearSlant = -.12f;
        setMedianFins(p, 0xf6c02a, 0xffe27a);
        setCaudalFin(p, 0xffbe14, 0xffdf5c);
    } else {  // palette: turquoise with a lime line
        setBody(p, 0x1664a8, 0x23a6c8, 0xe2fff4);
        p.stripes = {1.5f, .16f, .1f, .0f, .22f, .97f, rgb(0xd8f04a)};
        setMedianFins(p, 0x2a90c0, 0x7fd8e8);
        setCaudalFin(p, 0x2488c0, 0x78d4e8);
        p.caudalRim = rgb(0x143a78);
        p.caudalRimWidth = .08f;
    }
    setPairedFins(p, 0x9adcf0, 0xe4f8ff);
    p.iris = rgb(0xf2e6b0);
    p.scaleEdge = rgb(0xd8f4ff);
    p.scaleEdgeAmount = .3f;
    return fish;
}

Fish parrotfish(int variant) {
    Fish fish{.species = "Parrotfish", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .078f, .138f, .178f, .192f, .187f, .162f, .12f, .09f},
                 {0, .07f, .125f, .165f, .182f, .178f, .152f, .112f, .085f},
                 {0, .06f, .10f, .125f, .13f, .12f, .095f, .06f, .028f}};
    s.medianFins = {{FinKind::dorsal, .27f, .92f, {.05f, .09f, .09f, .09f, .10f, .06f}, .4f, .9f, .15f, .03f, 20},
                    {FinKind::anal, .56f, .92f, {.04f, .08f, .085f, .085f, .09f, .05f}, .5f, .9f, .15f, .03f, 12}};
    s.caudal = {.25f, .5f, .16f, .0f, 20};
    s.pectoral = {FinKind::pectoral, .29f, -.05f, .236f, 1.0f, .55f, .25f, .06f, 13};
    s.pelvic = {FinKind::pelvic, .32f, -.84f, .168f, .4f, .2f, .6f, .03f, 7};
    s.eyeRadius = .027f;
    s.eyeHeight = .45f;
    s.scaleSize = .06f;
    FishPattern& p = fish.pattern;
    if (variant % 2 == 0) {  // palette: teal with rose scale rims
        setBody(p, 0x0f9a98, 0x1fc0a8, 0x8fe8c0);
        p.scaleEdge = rgb(0xff7a8c);
        p.stripes = {3.2f, .16f, -.6f, .1f, .0f, .26f, rgb(0xff8a5c)};
        p.rear = rgb(0x2a8fe0);
        p.rearStart = .78f;
        p.rearSoftness = .25f;
        setMedianFins(p, 0xff7f7a, 0xffb070);
        p.medianRim = rgb(0x20a8d8);
        p.medianRimWidth = .2f;
        setCaudalFin(p, 0x1fb0c8, 0xffa070);
        p.caudalRim = rgb(0x1fa0e0);
        p.caudalRimWidth = .09f;
    } else {  // palette: violet to green
        setBody(p, 0x6a40c8, 0x8a5ad8, 0xf09ac0);
        p.scaleEdge = rgb(0x50e0d0);
        p.rear = rgb(0x2fb8b0);
        p.rearStart = .62f;
        p.rearSoftness = .3f;
        setMedianFins(p, 0x8a50d8, 0x48c8e0);
        setCaudalFin(p, 0x30b0c0, 0x70e0d0);
    }
    p.lips = rgb(0xffa080);
    p.lipsAmount = .6f;
    setPairedFins(p, 0x40c0c8, 0xffc090);
    p.iris = rgb(0xff9a3a);
    p.scaleEdgeAmount = .75f;
    p.scaleVariation = .1f;
    return fish;
}

}  // namespace defocus::engine::prototypes
