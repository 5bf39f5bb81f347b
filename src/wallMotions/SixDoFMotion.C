// SPDX-License-Identifier: GPL-3.0-or-later
// type sixDoF; ...
// The liquid moves the wall: wallMotions/SixDoFBody.H.

#include "wallMotions/SixDoFBody.H"
#include "wallMotions/WallMotion.H"

namespace shizuku
{

class SixDoFMotion : public WallMotion
{
public:
    explicit SixDoFMotion(const Dictionary& dict) : WallMotion(dict), body_(std::make_shared<SixDoFBody>(dict, start(), stop())) {}

    Pose at(double time) const override { return body_->at(time); }

    std::optional<Axis> axis() const override
    {
        if (!body_->turns()) return {};
        return Axis{body_->centre(), {0, 0, 1}};
    }

    SixDoFBody* body() const override { return body_.get(); }

private:
    std::shared_ptr<SixDoFBody> body_;
};

static const WallMotionTable::Add<SixDoFMotion> registered{"sixDoF", "the liquid and gravity move it"};

}
