/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

\*---------------------------------------------------------------------------*/

#include "slidingEdges.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::slidingEdges::slidingEdges
(
    const slidingSheets& sheets,
    const label nGroups,
    const scalar featureAngle,
    const labelList& vertex
)
:
    sheets_(sheets),
    nGroups_(nGroups),
    featureAngle_(featureAngle),
    chain_(vertex.size()),
    curve_(vertex.size(), -1)
{
    // Chains that meet at a vertex end there: points at it slide along none
    const gatheredFaces& faces = sheets_.faces();
    Map<label> chainAt(2*faces.edges().size());
    forAll(faces.edges(), i)
    {
        for (const label end : {0, 1})
        {
            const label v = faces.edges()[i][end];
            const label chaini = faces.chains()[i];
            if (!chainAt.insert(v, chaini) && chainAt[v] != chaini)
            {
                chainAt[v] = -1;
            }
        }
    }
    forAll(chain_, i)
    {
        chain_[i] = chainAt.lookup(vertex[i], -1);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::slidingEdges::makeCurve(const label curvei, const label chaini, const sheet& s)
{
    const gatheredFaces& faces = sheets_.faces();
    DynamicList<edge> edges;
    forAll(faces.edges(), edgei)
    {
        if (faces.chains()[edgei] == chaini)
        {
            edges.append(faces.edges()[edgei]);
        }
    }
    curves_.set
    (
        curvei,
        new slidingCurve(sheets_.vertices(s), edgeList(edges), featureAngle_)
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::slidingEdges::clear()
{
    curve_ = -1;
    curves_.clear();
    curves_.setSize(sheets_.faces().nChains()*(nGroups_ + 1));
}


void Foam::slidingEdges::slide(const label i, const sheet& s)
{
    if (chain_[i] >= 0)
    {
        curve_[i] = chain_[i]*(nGroups_ + 1) + s.group + 1;
        if (!curves_.set(curve_[i]))
        {
            makeCurve(curve_[i], chain_[i], s);
        }
    }
}


// ************************************************************************* //
