// Facts below one another, each with its name; longer than its room it scrolls.
#pragma once

#include <QScrollArea>

#include <utility>
#include <vector>

class QGridLayout;
class QLabel;

namespace console {

struct Fact {
    QString name;
    QString text;
    bool known = true; ///< false: said as plainly as the others, in the ink of what is not known

    bool operator==(const Fact&) const = default;
};

class FactList : public QScrollArea {
    Q_OBJECT
public:
    explicit FactList(const QString& accessibleName, QWidget* parent = nullptr);

    void setFacts(const std::vector<Fact>& facts);

private:
    std::vector<Fact> m_facts;
    QGridLayout* m_grid;
    std::vector<std::pair<QLabel*, QLabel*>> m_rows;
};

} // namespace console
