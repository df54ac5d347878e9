// A master that a test plugs in and out and whose buttons it holds.
#pragma once

#include "input/connected_master.hpp"

namespace console::test {

class PluggedMaster : public ConnectedMaster {
public:
    explicit PluggedMaster(MasterKind kind) : m_kind(kind) {}

    MasterKind kind() const override { return m_kind; }
    QString name() const override { return QStringLiteral("Test master"); }
    QString legend() const override { return QStringLiteral("held by a test"); }
    QString note() const override { return remark; }

    void plug(bool in)
    {
        if (!in)
            controls = {};
        setConnected(in);
    }

    HandControls controls; ///< what the next poll takes
    QString remark;

protected:
    void take(Instant) override { tell(controls); }

private:
    MasterKind m_kind;
};

} // namespace console::test
