#include "school/prototypes.h"

namespace defocus::engine::prototypes {

// ---- species of tall, disk-shaped fish -------------------------------------------------------------

Fish angelfish(int variant) {
    Fish fish{.species = "Angelfish", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .085f, .195f, .305f, .355f, .345f, .265f, .13f, .082f},
                 {0, .07f, .155f, .25f, .315f, .325f, .255f, .125f, .078f},
                 {0, .045f, .085f, .115f, .12f, .11f, .08f, .045f, .024f}};
    s.medianFins = {{FinKind::dorsal, .26f, .93f, {.02f, .07f, .09f, .13f, .25f, .10f}, .5f, 1.0f, .35f, .04f, 24},
                    {FinKind::anal, .46f, .93f, {.02f, .07f, .11f, .19f, .22f, .09f}, .5f, 1.0f, .3f, .03f, 18}};
    s.caudal = {.25f, .5f, .06f, .16f, 22};
    s.pectoral = {FinKind::pectoral, .31f, -.12f, .236f, 1.1f, .5f, .25f, .06f, 14};
    s.pelvic = {FinKind::pelvic, .34f, -.86f, .269f, .45f, .22f, .75f, .03f, 8};
    s.eyeHeight = .3f;
    FishPattern& p = fish.pattern;
    if (variant % 2 == 0) {  // palette: blue with golden lines
        setBody(p, 0x1c3fb0, 0x1d55cf, 0x2a6fe0);
        p.stripes = {13.0f, .42f, .7f, .25f, .33f, .97f, rgb(0xffc928)};
        p.face = rgb(0x3b8be8);
        p.faceAmount = .7f;
        p.bands = {{.135f, .04f, .02f, -.015f, rgb(0x0a1238), rgb(0x4fd2ff), .014f},
                   {.335f, .032f, -.05f, .02f, rgb(0x0b1644), rgb(0x35b8f5), .012f}};
        p.lips = rgb(0xf2f0e4);
        p.lipsAmount = .85f;
        setMedianFins(p, 0x1d4cc4, 0x2fa4ff);
        p.medianRim = rgb(0x8fe6ff);
        p.medianRimWidth = .07f;
        setCaudalFin(p, 0xffb511, 0xffd84a);
        setPairedFins(p, 0xffb31a, 0xffdf70);
        p.rear = rgb(0xf6b51c);
        p.rearStart = .955f;
        p.rearSoftness = .03f;
        p.iris = rgb(0xe8a020);
    } else {  // palette: vermilion with dark bars
        setBody(p, 0xf04a10, 0xff5d14, 0xff8f2e);
        p.bands = {{.42f, .020f, .03f, 0, rgb(0x2a0b16), {}, 0},
                   {.55f, .024f, .02f, 0, rgb(0x2a0b16), {}, 0},
                   {.68f, .022f, -.01f, 0, rgb(0x2a0b16), {}, 0},
                   {.80f, .014f, -.02f, 0, rgb(0x2a0b16), {}, 0}};
        p.face = rgb(0xff7a22);
        p.faceAmount = .6f;
        setMedianFins(p, 0xf04c12, 0xff7d2a);
        p.medianRim = rgb(0x3556e8);
        p.medianRimWidth = .16f;
        setCaudalFin(p, 0xff7a1e, 0xffc050);
        setPairedFins(p, 0xff7a20, 0xffc467);
        p.iris = rgb(0xffb030);
    }
    p.scaleEdge = variant % 2 == 0 ? rgb(0x58a8ff) : rgb(0xffb060);
    p.scaleEdgeAmount = .22f;
    return fish;
}

Fish butterflyfish(int variant) {
    Fish fish{.species = "Butterflyfish", .shape = {}, .pattern = {}};
    FishShape& s = fish.shape;
    s.outline = {{0, .034f, .115f, .29f, .365f, .36f, .28f, .12f, .066f},
                 {0, .03f, .095f, .235f, .315f, .325f, .255f, .115f, .064f},
                 {0, .026f, .062f, .10f, .108f, .098f, .072f, .04f, .02f}};
    s.medianFins = {{FinKind::dorsal, .27f, .95f, {.03f, .11f, .11f, .11f, .15f, .05f}, .35f, .9f, .12f, .12f, 20},
                    {FinKind::anal, .5f, .95f, {.03f, .11f, .13f, .15f, .13f, .05f}, .4f, .9f, .12f, .06f, 15}};
    s.caudal = {.2f, .48f, .02f, .1f, 18};
    s.pectoral = {FinKind::pectoral, .33f, -.12f, .224f, 1.0f, .55f, .2f, .05f, 12};
    s.pelvic = {FinKind::pelvic, .36f, -.85f, .224f, .5f, .2f, .8f, .03f, 8};
    s.eyeA = .155f;
    s.eyeRadius = .03f;
    s.eyeHeight = .22f;
    s.mouthLength = .03f;
    s.mouthDrop = .006f;
    s.gillA = .29f;
    FishPattern& p = fish.pattern;
    p.bands = {{.16f, .024f, .05f, .02f, rgb(0x11131c), rgb(0xfff3d0), .012f}};
    if (variant % 3 == 0) {  // palette: lemon yellow
        setBody(p, 0xffb400, 0xffcf12, 0xffe45c);
        p.stripes = {15.0f, .2f, .9f, .1f, .33f, .86f, rgb(0xd98a00)};
        p.bands.push_back({.93f, .018f, -.02f, 0, rgb(0x15161d), {}, 0});
        setMedianFins(p, 0xffc40e, 0xffdd3c);
        setCaudalFin(p, 0xffcb18, 0xfff0a0);
    } else if (variant % 3 == 1) {  // palette: pearl with golden rear half
        setBody(p, 0xe9e4d6, 0xf4f1e6, 0xfffbf0);
        p.stripes = {12.0f, .2f, 1.5f, .1f, .32f, .74f, rgb(0x3b4a63)};
        p.rear = rgb(0xffb70a);
        p.rearStart = .70f;
        p.rearSoftness = .07f;
        p.rearSlant = -.10f;
        setMedianFins(p, 0xffc21e, 0xffd640);
        p.medianRim = rgb(0x1c2230);
        p.medianRimWidth = .1f;
        setCaudalFin(p, 0xffb914, 0xffe27a);
    } else {  // palette: copper bands on cream
        setBody(p, 0xf3e2c4, 0xfaf0dc, 0xfffaf0);
        for (const float a : {.36f, .56f, .76f}) {
            p.bands.push_back({a, .038f, .03f, 0, rgb(0xf07c12), rgb(0x8a3c08), .007f});
        }
        setMedianFins(p, 0xf4a030, 0xffc860);
        setCaudalFin(p, 0xfbe6c0, 0xfff4e0);
    }
    setPairedFins(p, 0xffd040, 0xffeea0);
    p.iris = rgb(0xf2dc90);
    p.scaleEdge = rgb(0xfff6d0);
    p.scaleEdgeAmount = .25f;
    return fish;
}

Fish idol(int) {
    Fish fish = butterflyfish(1);
    fish.species = "Idol";
    FishShape& s = fish.shape;
    s.medianFins = {{FinKind::dorsal, .3f, .93f, {.30f, .62f, .26f, .17f, .12f, .05f}, .75f, 1.05f, .5f, .03f, 16},
                    {FinKind::anal, .5f, .93f, {.10f, .24f, .20f, .15f, .10f, .05f}, .55f, 1.0f, .25f, .03f, 13}};
    s.caudal = {.22f, .5f, .22f, .0f, 18};
    FishPattern& p = fish.pattern;
    setBody(p, 0xf2e7b8, 0xfbf3d6, 0xfffaf0);
    p.stripes.count = 0;
    p.bands = {{.245f, .085f, .05f, .03f, rgb(0x0d0f18), rgb(0xfff2a8), .006f},
               {.735f, .095f, -.03f, .03f, rgb(0x0d0f18), rgb(0xf6d53a), .02f}};
    p.rear = rgb(0xffd21e);
    p.rearStart = .56f;
    p.rearSoftness = .12f;
    p.rearSlant = 0;
    setMedianFins(p, 0xf6efd0, 0xfff8e4);
    p.medianRimWidth = 0;
    setCaudalFin(p, 0x10121c, 0x1a1d2c);
    p.caudalRim = rgb(0xbfe4ff);
    p.caudalRimWidth = .05f;
    p.lips = rgb(0xff9a1a);
    p.lipsAmount = .9f;
    p.face = rgb(0xfff6e0);
    return fish;
}

}  // namespace defocus::engine::prototypes
