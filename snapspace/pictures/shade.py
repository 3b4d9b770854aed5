"""Light on matte clay: lamps with soft shadows, an occluded sky, light bounced by the ground."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .ground import Ground, smoothed
from .lights import Lamp, Studio
from .shadow import ShadowCaster, ShadowMap
from .surface import ShadingPoints

Floats = NDArray[np.float32]

# Most texels across the mesh; a small picture needs no more than one per two pixels. A lamp has
# many directions: a shadow edge should be no sharper than their spacing, or the penumbra shows
# steps.
LAMP_TEXELS = 288
SKY_TEXELS = 160
COARSEST_TEXELS = 48
# A point of a plane stays out of its own shadow at any slope if it is lifted along the normal by
# the diagonal of a texel.
LIFT_TEXELS = 1.6
# Passes over the nodes of the ground, where the few directions of a light leave faint streaks.
SKY_SMOOTHING = 16
LAMP_SMOOTHING = 4
# Share of the surface's own light that its hidden parts return, since they are darker than average.
BOUNCED = 0.6
ROUGHNESS = 0.54
REFLECTANCE = 0.04  # at normal incidence, of a dielectric


def shade(
    points: ShadingPoints,
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    studio: Studio,
    ground: Ground | None,
    *,
    pixels: int,
) -> tuple[Floats, Ground | None]:
    """Radiance (3, k) in linear light of the shading points, and the ground with its shadows.

    Every direction of every lamp and of the sky has its own shadow map, so soft shadows, the
    darkening of crevices and the contact with the ground come from one mechanism and agree.
    Light between parts of the surface is a series of equal bounces: where a part of the sky is
    hidden, surface of about the same albedo and light is seen. `pixels`, the longer side of the
    picture, bounds the resolution of the maps.
    """
    caster = ShadowCaster(vertices, faces)
    finest = max(pixels // 2, COARSEST_TEXELS)
    sharp, soft = min(LAMP_TEXELS, finest), min(SKY_TEXELS, finest)
    lamp_maps = [caster.maps(lamp.directions, resolution=sharp) for lamp in studio.lamps]
    sky_maps = caster.maps(studio.sphere, resolution=soft)
    if ground is not None:
        ground = _shadowed(ground, studio, lamp_maps, sky_maps)

    diffuse, openness = _sky_light(points, studio, sky_maps, ground)
    specular = np.zeros_like(diffuse)
    for lamp, maps in zip(studio.lamps, lamp_maps, strict=True):
        matte, glossy = _lamp_light(points, lamp, maps)
        diffuse += matte
        specular += glossy
    diffuse /= 1.0 - BOUNCED * points.albedo * (1.0 - openness)
    return points.albedo * diffuse + specular, ground


def _shadowed(
    ground: Ground, studio: Studio, lamp_maps: list[list[ShadowMap]], sky_maps: list[ShadowMap]
) -> Ground:
    """The ground under all lamps and the sky, relative to open ground."""
    nodes = ground.node_positions()
    sky, lamps = np.zeros((2, nodes.shape[1]), dtype=np.float32)
    total = 0.0

    # The whole mesh is above the ground, so a line through the ground misses it upwards if it
    # misses it at all: directions below the horizon count as their opposites, which doubles the
    # directions of the sky.
    for shadow in sky_maps:
        height = abs(float(shadow.light @ studio.up))
        strength = 2.0 / len(sky_maps) * height * float(studio.sky_at(height).mean())
        sky += np.float32(strength) * shadow.beside(nodes)
        total += strength
    for lamp, maps in zip(studio.lamps, lamp_maps, strict=True):
        for shadow in maps:
            height = max(float(shadow.light @ studio.up), 0.0)
            strength = height * float(lamp.irradiance.mean()) / len(maps)
            lamps += np.float32(strength) * shadow.beside(nodes)
            total += strength
    light = smoothed(sky, passes=SKY_SMOOTHING) + smoothed(lamps, passes=LAMP_SMOOTHING)
    return ground.lit_by(light / np.float32(total))


def _sky_light(
    points: ShadingPoints, studio: Studio, maps: list[ShadowMap], ground: Ground | None
) -> tuple[Floats, Floats]:
    """Irradiance (3, k) from the whole sphere and the fraction (k,) of it that is open."""
    irradiance = np.zeros_like(points.position)
    reached = np.zeros(points.position.shape[1], dtype=np.float32)
    total = np.zeros_like(reached)
    for shadow in maps:
        cosine = _cosine(points, shadow.light)
        total += cosine
        cosine *= _lit(points, shadow)
        reached += cosine
        height = float(shadow.light @ studio.up)
        if ground is not None and height < 0.0:
            cosine *= ground.brightness_towards(points.position, shadow.light)
        for channel, radiance in enumerate(studio.sky_at(height).astype(np.float32)):
            irradiance[channel] += radiance * cosine
    irradiance *= np.float32(4.0 / len(maps))
    openness: Floats = (reached / np.maximum(total, 1e-6)).astype(np.float32)
    return irradiance, openness


def _lamp_light(points: ShadingPoints, lamp: Lamp, maps: list[ShadowMap]) -> tuple[Floats, Floats]:
    """Diffuse irradiance and reflected highlight, (3, k) each."""
    arriving = np.zeros(points.position.shape[1], dtype=np.float32)
    reached = np.zeros_like(arriving)
    for shadow in maps:
        lit = _lit(points, shadow)
        reached += lit
        lit *= _cosine(points, shadow.light)
        arriving += lit
    strength = (lamp.irradiance / len(maps)).astype(np.float32)[:, None]
    return strength * arriving, strength * (reached * _highlight(points, lamp))


def _highlight(points: ShadingPoints, lamp: Lamp) -> Floats:
    """Reflected over incoming light: Trowbridge-Reitz facets with Schlick's Fresnel term.

    [Walter et al. 2007; Schlick 1994], with the visibility term of Kelemen and Szirmay-Kalos
    2001.
    """
    light = lamp.center.astype(np.float32)[:, None]
    half = points.view + light
    half /= np.sqrt(_dot(half, half))
    facing = np.clip(_dot(points.normal, half), 0.0, 1.0)
    aligned = np.clip(_dot(light, half), 0.25, 1.0)
    alpha2 = np.float32(ROUGHNESS**4)
    facets = alpha2 / (facing * facing * (alpha2 - 1.0) + 1.0) ** 2
    fresnel = REFLECTANCE + (1.0 - REFLECTANCE) * (1.0 - aligned) ** 5
    result: Floats = _cosine(points, lamp.center) * facets * fresnel / (4.0 * aligned * aligned)
    return result


def _lit(points: ShadingPoints, shadow: ShadowMap) -> Floats:
    return shadow.lit(points.position + np.float32(LIFT_TEXELS * shadow.texel) * points.normal)


def _cosine(points: ShadingPoints, towards: NDArray[np.float64]) -> Floats:
    cosine = _dot(towards.astype(np.float32), points.normal)
    return np.clip(cosine, 0.0, None, out=cosine)


def _dot(a: Floats, b: Floats) -> Floats:
    """Dot products over the first axis, written out so that no BLAS decides on the rounding."""
    result: Floats = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return result
