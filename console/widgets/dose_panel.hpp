// Region H: contrast left, and the X-ray system's own figures repeated with their age.
#pragma once

#include "model/instrument_state.hpp"
#include "model/xray_state.hpp"

#include <QFrame>

class QGridLayout;
class QLabel;

namespace console {

class ContrastBar;
class FigureLabel;

class DosePanel : public QFrame {
    Q_OBJECT
public:
    DosePanel(const InstrumentState& instrument, const XraySystemState& xray, QWidget* parent = nullptr);
    void refresh(Instant now);

private:
    FigureLabel* addFigure(QGridLayout* grid, int row, int column, const QString& caption, const QString& widest);
    FigureLabel* addNote(const QString& widest);
    QGridLayout* makeGrid();
    void refreshContrast(Instant now);
    void refreshInjection(Freshness freshness, Instant now);

    const InstrumentState& m_instrument;
    const XraySystemState& m_xray;
    FigureLabel* m_contrast = nullptr;
    ContrastBar* m_contrastBar = nullptr;
    FigureLabel* m_fluoroscopy = nullptr;
    FigureLabel* m_kerma = nullptr;
    FigureLabel* m_kermaRate = nullptr;
    FigureLabel* m_product = nullptr;
    FigureLabel* m_injection = nullptr;
    FigureLabel* m_contrastNote = nullptr;
    FigureLabel* m_injectionNote = nullptr;
    FigureLabel* m_contrastAge = nullptr;
    FigureLabel* m_xrayAge = nullptr;
};

} // namespace console
