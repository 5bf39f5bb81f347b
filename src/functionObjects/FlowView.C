// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FlowView.H"

#include "models/density/Density.H"
#include "neighbours/ImagesOfLiquid.H"
#include "neighbours/WholeLiquid.H"
#include "drops/SeparateBodies.H"
#include "particles/Unfold.H"
#include "surface/CaseSurface.H"
#include "surface/MeshOfParts.H"

#include <limits>
#include <utility>

namespace shizuku
{

FlowView::FlowView
(
    const Time& time, Liquid& liquid, const Neighbourhood& near, const Walls& walls, const Models& models
)
:
    time(time), near(near), walls(walls), models(models), liquid_(liquid)
{}

const Liquid& FlowView::liquid()
{
    if (!whole_) computeDensities();
    return seen();
}

const Liquid& FlowView::part()
{
    computeDensities();
    return liquid_;
}

void FlowView::computeDensities()
{
    if (densityIsDue_)
    {
        liquid_.ghosts().copy(liquid_.position);
        computeDensity(liquid_, liquid_.position, near, walls);
    }
    densityIsDue_ = false;
}

void FlowView::cut(std::unique_ptr<Liquid> whole, bool sameBits, int many)
{
    whole_ = std::move(whole);
    mostInOnePiece_ = sameBits ? std::numeric_limits<int>::max() : many;
    allParticles_ = liquid_.parts().count(liquid_.owned());
}

void FlowView::recount()
{
    if (allParticles_) allParticles_ = liquid_.parts().count(liquid_.owned());
}

void FlowView::gather()
{
    if (allParticles_ && !isGathered_) gatherLiquid(liquid_, near, whole_.get());
    isGathered_ = true;
}

void FlowView::gatherSurface(bool wholeSurface)
{
    if (!allParticles_) return;
    if (*allParticles_ > mostInOnePiece_) return makeSurfaceInParts(wholeSurface);
    gather();
    if (parts().part() > 0) piece_.emplace();
}

void FlowView::makeSurfaceInParts(bool whole)
{
    std::vector<Position> share(liquid_.owned());
    liquid_.position.download(share.data(), liquid_.owned());
    const auto [cut, own] = mesher().particlesOfLayers(mirrored(std::move(share)), liquid_.parts());
    const Buffer<Position> particles(own);
    mesher().build(particles.span(), cut);
    MeshOfParts mesh(mesher(), liquid_.units().length, cut);
    enclosed_ = {mesh.volume(), liquid_.parts().count(mesher().particlesOutside())};
    if (whole) surface_ = mesh.whole();
    piece_ = std::move(mesh).piece();
}

const LiquidState& FlowView::state()
{
    computeDensities();
    if (!state_) state_ = meter_.measure(liquid_);
    return *state_;
}

const std::vector<Vector3>& FlowView::positionsOfPart()
{
    if (!positionsOfPart_) positionsOfPart_ = liquid_.positions();
    return *positionsOfPart_;
}

LiquidSurface& FlowView::mesher()
{
    if (!mesher_) mesher_.emplace(readSurfaceParameters(time.casePath(), liquid_.spacing()));
    return *mesher_;
}

const BoxSides* FlowView::sides() const
{
    const Images* images = liquid_.ghosts().images();
    return images ? &images->sides().box() : nullptr;
}

std::vector<Position> FlowView::mirrored(std::vector<Position> places) const
{
    return hasSides() ? unfolded(std::move(places), liquid_.ghosts().images()->sides()) : places;
}

void FlowView::buildUnfolded()
{
    const Sides& between = liquid_.ghosts().images()->sides();
    const double reach = bodyReach * liquid_.spacing();
    const bool isJoined = mayLieAcross(seen(), between, reach), isMirrored = between.box().has(Sides::Kind::symmetryPlane);
    if (!isJoined && !isMirrored) return mesher().build({seen().position.span().data, seen().owned()});
    std::vector<Position> places(seen().owned());
    seen().position.download(places.data(), seen().owned());
    if (isJoined) places = joinedAcross(std::move(places), between, reach);
    const Buffer<Position> whole(mirrored(std::move(places)));
    mesher().build(whole.span());
}

LiquidSurface& FlowView::builtSurface()
{
    if (std::exchange(surfaceIsDue_, false))
    {
        if (hasSides()) buildUnfolded();
        else mesher().build({seen().position.span().data, seen().owned()});
    }
    return *mesher_;
}

const TriangleMesh& FlowView::surface()
{
    if (!surface_) surface_ = toTriangleMesh(builtSurface().download(), liquid_.units().length);
    return *surface_;
}

const TriangleMesh& FlowView::surfacePiece()
{
    return piece_ ? *piece_ : surface();
}

double FlowView::surfaceVolume()
{
    if (enclosed_) return enclosed_->volume;
    const double unit = liquid_.units().length;
    return builtSurface().volume() * unit * unit * unit;
}

int FlowView::particlesOutsideSurface()
{
    return enclosed_ ? enclosed_->particlesOutside : builtSurface().particlesOutside();
}

void FlowView::prepareContacts()
{
    if (!wetted_) wetted_.emplace(time.casePath(), properties().spacing);
}

const std::vector<WettedSurface::Contact>& FlowView::contacts()
{
    prepareContacts();
    if (!contacts_) contacts_ = wetted_->find(surfacePiece());
    return *contacts_;
}

void FlowView::moved(double dt)
{
    dt_ = dt;
    densityIsDue_ = true;
    state_.reset();
    positionsOfPart_.reset();
    surface_.reset();
    piece_.reset();
    contacts_.reset();
    surfaceIsDue_ = true;
    enclosed_.reset();
    isGathered_ = false;
}

}
