/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "wholeFile.H"
#include "foamCompat.H"
#include "gzstream.h"
#include "OFstream.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "throwing.H"
#include "Time.H"
#include "uncollatedFileOperation.H"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <fcntl.h>
#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace wholeFile
{

//- A limit on the size of files (ulimit -f) is an error like a full disk, not a
//  signal that ends the program
class ignoreFileLimit
{
    void (*former_)(int);

public:

    ignoreFileLimit()
    :
        former_(std::signal(SIGXFSZ, SIG_IGN))
    {}

    ~ignoreFileLimit()
    {
        std::signal(SIGXFSZ, former_);
    }
};


static string failed(const fileName& path, const string& why)
{
    return
        "Cannot write " + path + ": " + why + "\n    What was there before is"
        " left as it was. Make room, or let the folder be writable";
}


static string reason(const int error)
{
    return error ? std::strerror(error) : "is the disk full?";
}


//- What the file system has to say about a file after it was closed; 0: nothing
static int errorOnDisk(const fileName& path)
{
    const int file = ::open(path.c_str(), O_RDONLY);
    if (file < 0)
    {
        return errno;
    }
    const int error = ::fsync(file) == 0 || errno == EINVAL ? 0 : errno;
    ::close(file);
    return error;
}


//- The length of what a compressed file has, as it can be read
static std::size_t lengthCompressed(const fileName& path)
{
    igzstream is(path.c_str());
    std::size_t length = 0;
    char part[65536];
    do
    {
        is.read(part, sizeof(part));
        length += std::size_t(is.gcount());
    }
    while (is.gcount() > 0);
    return length;
}


//- A compressed stream does not tell whether its end reached the disk
static bool writeCompressed
(
    const fileName& path,
    const IOstreamOption& option,
    const std::function<void(Ostream&)>& content
)
{
    OStringStream os;
    os.format(option.format());
    os.version(option.version());
    os.precision(IOstream::defaultPrecision());
    content(os);
    const std::string text(os.str());
    {
        ogzstream file(path.c_str(), std::ios_base::out|std::ios_base::binary);
        file.write(text.data(), std::streamsize(text.size()));
    }
    return lengthCompressed(path) == text.size();
}


static bool writePlain
(
    const fileName& path,
    const IOstreamOption& option,
    const std::function<void(Ostream&)>& content
)
{
    OFstream os(path);
    if (!os.good())
    {
        return false;
    }
    os.format(option.format());
    os.version(option.version());
    os.precision(IOstream::defaultPrecision());
    content(os);
    os.flush();
    return os.good();
}


//- What went wrong; empty if all of it is on the disk
static string writeAs
(
    const fileName& beside,
    const fileName& path,
    const IOstreamOption& option,
    const std::function<void(Ostream&)>& content
)
{
    if (exists(path) && !isFile(path))
    {
        return failed(path, "it is there and no file");
    }
    bool good = false;
    int error = 0;
    try
    {
        const throwing errors;
        mkDir(path.path());
        errno = 0;
        good =
            option.compression() == IOstream::COMPRESSED
          ? writeCompressed(beside, option, content)
          : writePlain(beside, option, content);
        error = good ? errorOnDisk(beside) : errno;
    }
    catch (const Foam::error& wrong)
    {
        error = errno;
        ::unlink(beside.c_str());
        return failed(path, error ? reason(error) : wrong.message());
    }
    if (!good || error)
    {
        ::unlink(beside.c_str());
        return failed(path, reason(error));
    }
    return string();
}


static string rename(const fileName& from, const fileName& to)
{
    if (::rename(from.c_str(), to.c_str()) == 0)
    {
        return string();
    }
    const string why(failed(to, reason(errno)));
    ::unlink(from.c_str());
    return why;
}

//- Collective: what the first rank has to say, if any
static void stopIf(const string& wrong, const fileName& written)
{
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = wrong;
    foamCompat::allGatherList(all);
    for (const string& one : all)
    {
        if (!one.empty())
        {
            ::unlink(written.c_str());
            FatalErrorInFunction << one.c_str() << nl << exit(FatalError);
        }
    }
}

} // End namespace wholeFile
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::fileName Foam::wholeFile::beside(const fileName& path)
{
    return path.path()/("partial" + Foam::name(label(pid())) + path.name());
}


Foam::string Foam::wholeFile::write
(
    const fileName& path,
    const std::function<void(Ostream&)>& content
)
{
    const ignoreFileLimit limit;
    const fileName written(beside(path));
    const string wrong(writeAs(written, path, IOstreamOption(), content));
    return wrong.empty() ? rename(written, path) : wrong;
}


void Foam::wholeFile::writeOrStop
(
    const fileName& path,
    const std::function<void(Ostream&)>& content
)
{
    const string wrong(write(path, content));
    if (!wrong.empty())
    {
        FatalErrorInFunction << wrong.c_str() << nl << exit(FatalError);
    }
}


Foam::string Foam::wholeFile::writeBy
(
    const fileName& path,
    const std::function<bool(const fileName&)>& writer
)
{
    const ignoreFileLimit limit;
    if (exists(path) && !isFile(path))
    {
        return failed(path, "it is there and no file");
    }
    const fileName written(beside(path));
    bool good = false;
    int error = 0;
    try
    {
        const throwing errors;
        mkDir(path.path());
        errno = 0;
        good = writer(written);
        error = good ? errorOnDisk(written) : errno;
    }
    catch (const Foam::error& wrong)
    {
        error = errno;
        ::unlink(written.c_str());
        return failed(path, error ? reason(error) : wrong.message());
    }
    if (!good || error)
    {
        ::unlink(written.c_str());
        return failed(path, reason(error));
    }
    return rename(written, path);
}


void Foam::wholeFile::checkEnd(const fileName& path, const string& end)
{
    if (!Pstream::master())
    {
        return;
    }
    std::ifstream file(path, std::ios::binary);
    file.seekg(-std::min<std::streamoff>(fileSize(path), 100), std::ios::end);
    const std::string last
    (
        (std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>()
    );
    if (last.find(end) == std::string::npos)
    {
        FatalErrorInFunction
            << "Cannot write " << path << ": it does not end as it should. Is"
            << " the disk full?" << nl
            << "    Make room, or let the folder be writable" << nl
            << exit(FatalError);
    }
}


void Foam::wholeFile::writeObject(const regIOobject& object)
{
    const ignoreFileLimit limit;
    const Time& time = object.time();
    const bool compressed =
        time.writeCompression() == IOstream::COMPRESSED;
    const fileName plain(object.objectPath());
    const fileName path(compressed ? fileName(plain + ".gz") : plain);
    const fileName written(beside(path));
    string wrong;

    // Other file handlers put several ranks into one file, by themselves
    const bool own = isA<fileOperations::uncollatedFileOperation>(fileHandler());
    if (own)
    {
        const IOstreamOption option
        (
            time.writeFormat(),
            compressed ? IOstream::COMPRESSED : IOstream::UNCOMPRESSED
        );
        wrong = writeAs
        (
            written,
            path,
            option,
            [&](Ostream& os)
            {
                object.writeHeader(os);
                object.writeData(os);
                IOobject::writeEndDivider(os);
            }
        );
    }
    else if (!object.write())
    {
        wrong = failed(path, "is the disk full, or the folder read-only?");
    }

    // None is renamed before all are complete
    stopIf(wrong, written);
    if (own)
    {
        wrong = rename(written, path);

        // Of a plain and a compressed file the plain one is read
        ::unlink((compressed ? plain : fileName(plain + ".gz")).c_str());
    }
    stopIf(wrong, written);
}


// ************************************************************************* //
